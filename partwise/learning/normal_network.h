// A network that reads the normals of every pixel off a picture: four scales from coarse to fine, each of which sees
// the picture and what the scale before has found (dissertation, section 3.3.2, after Eigen and Fergus 2015,
// "Predicting depth, surface normals and semantic labels").
//
//   1  convolutions down to a 32nd of the size and two fully connected layers, which see the whole picture; 8 x 8
//   2  four convolutions at a quarter of the size
//   3  three at half the size
//   4  two at the full size; their last three channels, brought to unit length, are the normals
//
// Shapes: pictures B x 4 x S x S, red, green and blue as they are seen (after tone mapping, 0 to 1, zero outside the
// object) and the mask (0 or 1); result B x 3 x S x S, unit vectors in camera space (+x right, +y up, +z towards the
// viewer), zero where the mask is. Errors: CheckFailed for other shapes, and for sizes that 32 does not divide.
#pragma once

#include <ATen/core/Tensor.h>

#include <memory>

namespace torch::nn {
class Module;
}

namespace partwise {

struct NormalNetworkSettings {
  int size = 128;
  int channels = 48;     // of the convolutions at half the size; the others' follow. Multiples of 8
  double dropout = 0.2;  // of the fully connected layers
};

class NormalNetwork {
 public:
  explicit NormalNetwork(const NormalNetworkSettings& settings = {});

  at::Tensor operator()(const at::Tensor& pictures) const;

  const NormalNetworkSettings& settings() const;
  std::shared_ptr<torch::nn::Module> module() const;

 private:
  struct Scales;
  std::shared_ptr<Scales> scales_;
};

}  // namespace partwise
