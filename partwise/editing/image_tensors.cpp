#include "partwise/editing/image_tensors.h"

#include <ATen/Functions.h>

#include <algorithm>

namespace partwise {

at::Tensor planes_of(const Image& image) {
  at::Tensor rows = at::empty({image.height, image.width, image.channels});
  std::ranges::copy(image.values, rows.data_ptr<float>());
  return rows.permute({2, 0, 1}).contiguous();
}

Image image_of(const at::Tensor& planes) {
  const at::Tensor rows = planes.permute({1, 2, 0}).contiguous();
  Image image(static_cast<int>(rows.size(1)), static_cast<int>(rows.size(0)), static_cast<int>(rows.size(2)));
  std::copy_n(rows.data_ptr<float>(), image.values.size(), image.values.begin());
  return image;
}

at::Tensor cropped(const Image& image, int x, int y, int side) {
  at::Tensor result = at::zeros({1, image.channels, side, side});
  const std::int64_t plane = std::int64_t{side} * side;
  float* out = result.data_ptr<float>();
  for (int row = std::max(0, -y); row < std::min(side, image.height - y); ++row)
    for (int column = std::max(0, -x); column < std::min(side, image.width - x); ++column)
      for (int c = 0; c < image.channels; ++c)
        out[c * plane + std::int64_t{row} * side + column] = image.pixel(column + x, row + y)[c];
  return result;
}

at::Tensor scaled(const at::Tensor& images, std::int64_t rows, std::int64_t columns) {
  if (images.size(2) == rows && images.size(3) == columns) return images;
  if (images.size(3) > columns) return at::adaptive_avg_pool2d(images, {rows, columns});
  return at::upsample_bilinear2d(images, {rows, columns}, /*align_corners=*/false);
}

at::Tensor resized(const at::Tensor& squares, std::int64_t side) { return scaled(squares, side, side); }

}  // namespace partwise
