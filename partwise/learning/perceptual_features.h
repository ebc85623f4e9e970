// How alike two pictures look to a network that was trained to name what it sees: the perceptual loss (dissertation,
// section 3.3.3; Johnson, Alahi and Fei-Fei 2016).
//
// The network is the start of VGG-16 (Simonyan and Zisserman 2015), four convolutions of 3 x 3 with rectifiers, its
// weights frozen; models/README.md says where they are from. Compared is what leaves the second and the fourth.
//
// Shapes: pictures B x 3 x H x W, red, green and blue as they are shown, 0 to 1, sides of 4 pixels or more; features
// B x 64 x H x W and B x 128 x H/2 x W/2. Float or double, as the pictures are. Differentiable in the pictures. Errors:
// InputError for a file that is not these weights; CheckFailed for other shapes.
#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace partwise {

class PerceptualFeatures {
 public:
  static PerceptualFeatures shipped();
  explicit PerceptualFeatures(const std::filesystem::path& path);

  std::vector<at::Tensor> operator()(const at::Tensor& pictures) const;

 private:
  struct Convolutions;
  std::shared_ptr<const Convolutions> convolutions_;
};

// A number for each of B pairs: the mean over channels and places of the squared difference of features, each channel's
// in units of `feature_scale`, summed over the two layers.
at::Tensor perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b);

// Features are of the order of hundreds: distances of pictures that have little in common are then about 1.
inline constexpr double feature_scale = 1000;

}  // namespace partwise
