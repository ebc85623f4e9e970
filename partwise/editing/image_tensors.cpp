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

}  // namespace partwise
