// Images, whose channels are interleaved, as tensors of planes, and back. Internal to this room and its benchmarks.
#pragma once

#include <ATen/core/Tensor.h>

#include "partwise/imaging/image.h"

namespace partwise {

at::Tensor planes_of(const Image& image);  // C x h x w, floats
Image image_of(const at::Tensor& planes);  // of C x h x w floats

}  // namespace partwise
