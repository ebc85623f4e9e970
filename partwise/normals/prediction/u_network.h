// A U-shaped network (dissertation, Fig. 4.2, after Zhang and others 2017, "Physically-based rendering for indoor scene
// understanding using convolutional neural networks"): VGG-16's thirteen convolutions and five poolings without the
// fully connected layers, and the same mirrored.
//
// Each unpooling puts values back where the pooling across from it took them, and what went into that pooling is added.
// All convolutions are 3 x 3; all but the last are normalised over groups of channels and rectified
// (learning/network_blocks.h). VGG-16 begins with 64 channels and ends with 512; this one is as wide as is wanted.
//
// Any size that 32 divides. With 16 channels, in and out of 4 and 3: 1.04 million parameters, 24.8 thousand
// multiply-adds a pixel, 0.41 billion for 128 x 128. Shapes: B x in x H x W to B x out x H x W. Errors: CheckFailed for
// other shapes and channels that 16 does not divide.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <memory>

namespace torch::nn {
class Module;
}

namespace partwise {

struct UNetworkSettings {
  int in = 4, out = 3;  // channels
  int channels = 16;    // at the full size; below it 1 1/2, 3, 6 and 6 times as many
};

// The least size that it takes, of one at least as large.
std::int64_t whole_blocks(std::int64_t size);

class UNetwork {
 public:
  explicit UNetwork(const UNetworkSettings& settings = {});

  at::Tensor operator()(const at::Tensor& maps) const;

  const UNetworkSettings& settings() const;
  std::shared_ptr<torch::nn::Module> module() const;

 private:
  struct Blocks;
  std::shared_ptr<Blocks> blocks_;
};

}  // namespace partwise
