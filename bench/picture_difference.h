// How far a linear picture is from the true one, as the tables of the dissertation tell it (imaging/image_metrics.h):
// {"l2", "ssim", "l2_frame", "ssim_frame", "same_exposure": {the same}}, over the object and over the frame; each
// picture exposed by its own object's median, and both as the true one.
#pragma once

#include <ATen/core/Tensor.h>

#include <nlohmann/json.hpp>

namespace partwise::bench {

// Of 1 x 3 x S x S; the mask 1 x 1 x S x S. "ssim" is missing where no window lies on the object.
nlohmann::ordered_json difference(const at::Tensor& image, const at::Tensor& truth, const at::Tensor& mask);

}  // namespace partwise::bench
