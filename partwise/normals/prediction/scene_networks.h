// What reads a scene off one picture: its normals, and where it is trained for what the picture would look like as well
// (dissertation, section 4.3), its material pixel by pixel and its light.
//
//   normals   the U-shaped network (u_network.h)
//   material  another one, of 32 outputs: the numbers of the shipped basis (appearance/material/dsbrdf_basis.h)
//   light     five convolutions that each halve the size, their means over 4 x 5 fields, two fully connected layers: a
//             map of 8 x 16 about the camera, as the natural logarithm of radiance
//
// Shapes: pictures B x 4 x H x W (colours as they are shown, and the mask), whose sizes 32 divides. Errors: CheckFailed
// for other shapes and for material and light of networks without them.
#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <memory>

#include "partwise/normals/prediction/normal_predictor.h"

namespace partwise {

struct SceneNetworksSettings {
  int width = 160;       // of the pictures that they learn from
  int channels = 16;     // UNetworkSettings::channels
  bool readers = false;  // of material and light
};

class SceneNetworks {
 public:
  static constexpr const char* kind = "scenes";  // of weights files

  explicit SceneNetworks(const SceneNetworksSettings& settings);

  const NormalPredictor& normals() const;
  at::Tensor materials(const at::Tensor& pictures) const;     // B x 32 x H x W
  at::Tensor log_radiance(const at::Tensor& pictures) const;  // B x 3 x 8 x 16

  const SceneNetworksSettings& settings() const;
  torch::nn::Module& module() const;
  WeightsFile weights() const;

 private:
  struct Modules;
  std::shared_ptr<Modules> modules_;
};

SceneNetworks read_scene_networks(const std::filesystem::path& path);

}  // namespace partwise
