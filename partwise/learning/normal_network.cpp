#include "partwise/learning/normal_network.h"

#include <ATen/Functions.h>

#include <vector>

#include "partwise/base/error.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

constexpr int coarse_side = 8;  // of what the first scale gives
constexpr int handed_on = 16;   // channels from scale to scale
constexpr int largest_divisor = 32;

at::Tensor doubled(const at::Tensor& maps, int side) {
  return at::upsample_bilinear2d(maps, {side, side}, /*align_corners=*/false);
}

}  // namespace

struct NormalNetwork::Scales : torch::nn::Module {
  explicit Scales(const NormalNetworkSettings& given) : settings(given) {
    PARTWISE_CHECK(settings.size % largest_divisor, ==, 0);
    const int c = settings.channels, first = c / 2 / 8 * 8 + 8, wide = c + 16;  // multiples of 8
    const int deepest = settings.size / largest_divisor;
    const auto down = [](const std::vector<int>& channels) {
      return halving_convolutions(4, channels, Normalisation::groups);
    };
    encoder = register_module("encoder", down({first, c, 3 * c / 2 / 8 * 8, 2 * c, 2 * c}));
    narrow = register_module("narrow", convolution(2 * c, 32, 1));
    whole = register_module("whole", connected(32 * deepest * deepest, 256, settings.dropout));
    spread = register_module("spread", torch::nn::Linear(256, handed_on * coarse_side * coarse_side));

    quarter_picture = register_module("quarter_picture", down({first, c}));
    quarter = register_module("quarter", torch::nn::Sequential());
    for (int i = 0; i < 3; ++i) quarter->extend(*convolution(i == 0 ? c + handed_on : wide, wide));
    quarter->extend(*convolution(wide, handed_on));

    half_picture = register_module("half_picture", convolution(4, c - handed_on, 5, 2));
    half = register_module("half", torch::nn::Sequential());
    half->extend(*convolution(c, c));
    half->extend(*convolution(c, c));
    half->extend(*convolution(c, handed_on));

    full = register_module("full", torch::nn::Sequential());
    full->extend(*convolution(4 + handed_on, 32));
    full->push_back(torch::nn::Conv2d(torch::nn::Conv2dOptions(32, 3, 3).padding(1)));
  }

  at::Tensor forward(const at::Tensor& pictures) {
    const int size = settings.size;
    const at::Tensor seen = whole->forward(narrow->forward(encoder->forward(pictures)).flatten(1));
    const at::Tensor coarse = spread->forward(seen).reshape({-1, handed_on, coarse_side, coarse_side});
    at::Tensor maps = at::cat({quarter_picture->forward(pictures), doubled(coarse, size / 4)}, 1);
    maps = doubled(quarter->forward(maps), size / 2);
    maps = at::cat({half_picture->forward(pictures), maps}, 1);
    maps = at::cat({pictures, doubled(half->forward(maps), size)}, 1);
    return unit_vectors(full->forward(maps)) * pictures.narrow(1, 3, 1);
  }

  NormalNetworkSettings settings;
  torch::nn::Sequential encoder{nullptr}, narrow{nullptr}, whole{nullptr};
  torch::nn::Linear spread{nullptr};
  torch::nn::Sequential quarter_picture{nullptr}, quarter{nullptr}, half_picture{nullptr}, half{nullptr}, full{nullptr};
};

NormalNetwork::NormalNetwork(const NormalNetworkSettings& settings) : scales_(std::make_shared<Scales>(settings)) {}

at::Tensor NormalNetwork::operator()(const at::Tensor& pictures) const {
  PARTWISE_CHECK(pictures.dim(), ==, 4);
  PARTWISE_CHECK(pictures.size(1), ==, 4);
  for (const int side : {2, 3}) PARTWISE_CHECK(pictures.size(side), ==, scales_->settings.size);
  return scales_->forward(pictures);
}

const NormalNetworkSettings& NormalNetwork::settings() const { return scales_->settings; }

std::shared_ptr<torch::nn::Module> NormalNetwork::module() const { return scales_; }

}  // namespace partwise
