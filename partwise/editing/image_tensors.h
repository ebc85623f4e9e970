// Images, whose channels are interleaved, as tensors of planes, and back. Internal to the rooms that have
// networks for photos, and to benchmarks.
#pragma once

#include <ATen/core/Tensor.h>

#include "partwise/imaging/image.h"

namespace partwise {

at::Tensor planes_of(const Image& image);  // C x h x w, floats
Image image_of(const at::Tensor& planes);  // of C x h x w floats

// 1 x C x side x side: the square whose upper left pixel is (x, y), zero beyond the image.
at::Tensor cropped(const Image& image, int x, int y, int side);

// Of B x C x h x w: means of pixels where they become smaller, else bilinear. Both sides alike, or nearly so.
at::Tensor scaled(const at::Tensor& images, std::int64_t rows, std::int64_t columns);
at::Tensor resized(const at::Tensor& squares, std::int64_t side);  // B x C x s x s

}  // namespace partwise
