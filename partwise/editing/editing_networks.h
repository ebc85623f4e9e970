// What reads an object's normals, material and light off one picture (dissertation, section 3.3.2): three networks that
// share nothing, the normals' that of learning/normal_network.h.
//
//   material  seven convolutions that each halve the size, three fully connected layers, tanh: 108 coefficients scaled
//             as material_range.h says; the range is a part of the network
//   light     seven such convolutions, two fully connected layers, four deconvolutions: a map of 64 x 128, as the
//             natural logarithm of radiance; its level and colour, which deconvolutions with normalisation lose, are
//             told by a layer of their own and added
//
// Shapes: pictures B x 4 x S x S, as NormalNetwork has them. Radiance is in the unit in which a picture's value 1 is
// the largest that it shows. Errors: CheckFailed for other shapes and for sizes that 32 does not divide or below 128.
#pragma once

#include <ATen/core/Tensor.h>

#include <memory>
#include <string>

#include "partwise/editing/material_range.h"
#include "partwise/learning/checkpoint.h"
#include "partwise/learning/normal_network.h"

namespace partwise {

inline constexpr int light_rows = 64, light_columns = 128;

// Radiance is told from dark by this much: the logarithm is that of radiance and this.
inline constexpr double darkest_radiance = 0.01;

struct EditingNetworksSettings {
  int size = 128;
  int normal_channels = 48;
  double dropout = 0.2;
};

struct PictureLayers {
  at::Tensor normals;       // B x 3 x S x S
  at::Tensor material;      // B x 108, scaled
  at::Tensor log_radiance;  // B x 3 x 64 x 128
};

class EditingNetworks {
 public:
  EditingNetworks(const EditingNetworksSettings& settings, const MaterialRange& range);

  at::Tensor normals(const at::Tensor& pictures) const;
  at::Tensor scaled_material(const at::Tensor& pictures) const;
  at::Tensor log_radiance(const at::Tensor& pictures) const;
  PictureLayers operator()(const at::Tensor& pictures) const;

  const NormalNetwork& normal_network() const;
  const EditingNetworksSettings& settings() const;
  MaterialRange range() const;
  torch::nn::Module& module() const;
  WeightsFile weights() const;

 private:
  struct Modules;
  std::shared_ptr<Modules> modules_;
};

// Of a weights file. Errors: those of reading; InputError for another kind of network.
EditingNetworks read_editing_networks(const std::filesystem::path& path);

at::Tensor log_of_radiance(const at::Tensor& radiance);
at::Tensor radiance_of_log(const at::Tensor& log_radiance);

}  // namespace partwise
