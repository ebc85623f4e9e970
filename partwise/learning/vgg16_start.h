// The parameters of VGG-16's first four convolutions, as they lie in weights files. Internal to this room and to the
// program that makes the shipped file.
#pragma once

#include <torch/nn/module.h>

#include <array>
#include <string>

namespace partwise {

inline constexpr const char* vgg16_start_kind = "vgg16-start";

struct Vgg16Start : torch::nn::Module {
  static constexpr std::array<int, 5> channels = {3, 64, 64, 128, 128};  // what goes in, and what leaves each

  Vgg16Start();

  std::array<at::Tensor, 4> kernels;  // out x in x 3 x 3; the first takes blue, green, red, 0..255 less their means
  std::array<at::Tensor, 4> biases;
};

}  // namespace partwise
