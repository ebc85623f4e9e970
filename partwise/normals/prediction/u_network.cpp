#include "partwise/normals/prediction/u_network.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <array>
#include <tuple>

#include "partwise/base/error.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

constexpr std::size_t depth = 5;
constexpr int largest_divisor = 1 << depth;
constexpr std::array<int, depth> convolutions{2, 2, 3, 3, 3};  // of VGG-16 before each pooling

}  // namespace

struct UNetwork::Blocks : torch::nn::Module {
  explicit Blocks(const UNetworkSettings& given) : settings(given) {
    const int c = settings.channels;
    PARTWISE_CHECK(c % 16, ==, 0);
    const std::array<int, depth> widths{c, 3 * c / 2, 3 * c, 6 * c, 6 * c};
    for (std::size_t i = 0; i < depth; ++i) {
      const int above = i == 0 ? settings.in : widths[i - 1];
      down[i] = register_module("down" + std::to_string(i), torch::nn::Sequential());
      up[i] = register_module("up" + std::to_string(i), torch::nn::Sequential());
      for (int k = 0; k < convolutions[i]; ++k) down[i]->extend(*convolution(k == 0 ? above : widths[i], widths[i]));
      for (int k = 1; k < convolutions[i]; ++k) up[i]->extend(*convolution(widths[i], widths[i]));
      if (i > 0) up[i]->extend(*convolution(widths[i], above));
    }
    up[0]->push_back(torch::nn::Conv2d(torch::nn::Conv2dOptions(c, settings.out, 3).padding(1)));
  }

  at::Tensor forward(at::Tensor maps) {
    std::array<at::Tensor, depth> before, places;
    for (std::size_t i = 0; i < depth; ++i) {
      before[i] = down[i]->forward(maps);
      std::tie(maps, places[i]) = at::max_pool2d_with_indices(before[i], 2, 2);
    }
    for (std::size_t i = depth; i-- > 0;) {
      const at::Tensor unpooled = at::max_unpool2d(maps, places[i], before[i].sizes().slice(2));
      maps = up[i]->forward(unpooled + before[i]);
    }
    return maps;
  }

  UNetworkSettings settings;
  std::array<torch::nn::Sequential, depth> down{nullptr, nullptr, nullptr, nullptr, nullptr}, up = down;
};

std::int64_t whole_blocks(std::int64_t size) {
  return (size + largest_divisor - 1) / largest_divisor * largest_divisor;
}

UNetwork::UNetwork(const UNetworkSettings& settings) : blocks_(std::make_shared<Blocks>(settings)) {}

at::Tensor UNetwork::operator()(const at::Tensor& maps) const {
  PARTWISE_CHECK(maps.dim(), ==, 4);
  PARTWISE_CHECK(maps.size(1), ==, blocks_->settings.in);
  for (const int side : {2, 3}) {
    PARTWISE_CHECK(maps.size(side), >, 0);
    PARTWISE_CHECK(maps.size(side) % largest_divisor, ==, 0);
  }
  return blocks_->forward(maps);
}

const UNetworkSettings& UNetwork::settings() const { return blocks_->settings; }
std::shared_ptr<torch::nn::Module> UNetwork::module() const { return blocks_; }

}  // namespace partwise
