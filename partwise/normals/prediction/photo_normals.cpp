#include "partwise/normals/prediction/photo_normals.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

constexpr float covered = 0.5f;

Image object_of(const Photo& photo) {
  Image object(photo.shown.width, photo.shown.height, 1);
  for (const Image& region : photo.regions)
    std::ranges::transform(object.values, region.values, object.values.begin(), std::plus<>());
  return object;
}

// Pixels without a normal take the mean of those about them that have one, ring by ring until all have.
at::Tensor grown(at::Tensor normals) {
  for (std::int64_t ring = 0; ring < normals.size(3); ++ring) {
    const at::Tensor empty = normals.square().sum(1, true) == 0;
    if (!empty.any().item<bool>()) break;
    const at::Tensor about = at::avg_pool2d(normals, {3, 3}, {1, 1}, {1, 1});
    normals = at::where(empty, unit_vectors(about), normals);
  }
  return normals;
}

// With empty rows and columns about it, to what the network takes.
at::Tensor padded(const at::Tensor& picture) {
  const std::int64_t rows = whole_blocks(picture.size(2)) - picture.size(2),
                     columns = whole_blocks(picture.size(3)) - picture.size(3);
  return at::constant_pad_nd(picture, {columns / 2, columns - columns / 2, rows / 2, rows - rows / 2});
}

}  // namespace

Image photo_normals(const NormalPredictor& predictor, const Photo& photo) {
  const at::NoGradGuard no_gradient;
  const std::int64_t size = predictor.settings().size;
  const Image object = object_of(photo);
  const Crop crop = crop_of(photo);
  const auto square = [&](const Image& image) { return cropped(image, crop.x, crop.y, crop.side); };
  const at::Tensor mask = (resized(square(object), size) > covered).to(at::kFloat);
  const at::Tensor colours = resized(square(photo.shown), size);
  const at::Tensor found = predictor.both_ways(at::cat({colours * mask, mask}, 1));
  const Image normals = image_of(resized(grown(found), crop.side)[0]);

  Image result(photo.shown.width, photo.shown.height, 3);
  for (int y = std::max(0, -crop.y); y < std::min(crop.side, result.height - crop.y); ++y) {
    for (int x = std::max(0, -crop.x); x < std::min(crop.side, result.width - crop.x); ++x) {
      if (*object.pixel(x + crop.x, y + crop.y) <= covered) continue;
      const float* from = normals.pixel(x, y);
      const float length = std::hypot(from[0], from[1], from[2]);
      for (int k = 0; k < 3 && length > 0; ++k) result.pixel(x + crop.x, y + crop.y)[k] = from[k] / length;
    }
  }
  return result;
}

Image scene_normals(const NormalPredictor& predictor, const Image& shown) {
  PARTWISE_CHECK(shown.channels, ==, 3);
  PARTWISE_CHECK(predictor.settings().architecture == NormalArchitecture::u, ==, true);
  const at::NoGradGuard no_gradient;
  const double scale = static_cast<double>(predictor.settings().size) / std::max(shown.width, shown.height);
  const auto reduced = [&](int side) { return std::max<std::int64_t>(1, std::lround(side * scale)); };
  const std::int64_t rows = reduced(shown.height), columns = reduced(shown.width);
  const at::Tensor colours = scaled(planes_of(shown).unsqueeze(0), rows, columns);
  const at::Tensor picture = padded(at::cat({colours, at::ones({1, 1, rows, columns})}, 1));
  const std::int64_t above = (picture.size(2) - rows) / 2, left = (picture.size(3) - columns) / 2;
  const at::Tensor found = predictor.both_ways(picture).narrow(2, above, rows).narrow(3, left, columns);
  return image_of(unit_vectors(scaled(found, shown.height, shown.width))[0]);
}

}  // namespace partwise
