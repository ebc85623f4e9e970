#include "partwise/editing/encoder_decoder.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

constexpr const char* kind = "encoder_decoder";
constexpr int halvings = 7, smallest = 1 << halvings;
constexpr int material_features = 128, other_features = 192;

const std::vector<int> widths = {32, 48, 64, 96, 128, 128, 160};  // of the encoder's maps, from large to small

}  // namespace

struct EncoderDecoder::Modules : torch::nn::Module {
  Modules(int given, const MaterialRange& range) : size(given), deepest(given / smallest) {
    PARTWISE_CHECK(size, >=, smallest);
    PARTWISE_CHECK(size & (size - 1), ==, 0);
    int from = 4;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      encoder.push_back(
          register_module(fmt::format("encoder{}", i), halving_convolution(from, widths[i], i == 0 ? 5 : 3)));
      from = widths[i];
    }
    const int values = widths.back() * deepest * deepest;
    split = register_module("split", connected(values, material_features + other_features, 0));
    regression = register_module("regression", torch::nn::Linear(material_features, dsbrdf_size));
    wanted_features = register_module("wanted", connected(dsbrdf_size, material_features, 0));
    wanted_features->extend(*connected(material_features, material_features, 0));
    join = register_module("join", connected(material_features + other_features, values, 0));
    // Each doubles the size and then sees the encoder's map of that size.
    from = widths.back();
    for (std::size_t i = widths.size() - 1; i > 0; --i) {
      decoder.push_back(register_module(fmt::format("decoder{}", i), doubling_convolution(from, widths[i - 1])));
      from = 2 * widths[i - 1];
    }
    last = register_module("last", doubling_convolution(from, 24));
    drawn = register_module("drawn", torch::nn::Conv2d(torch::nn::Conv2dOptions(24 + 4, 3, 3).padding(1)));
    low = register_buffer("material_low", range.low().clone());
    high = register_buffer("material_high", range.high().clone());
  }

  Redrawn forward(const at::Tensor& pictures, const at::Tensor& wanted) {
    std::vector<at::Tensor> maps = {pictures};
    for (auto& each : encoder) maps.push_back(each->forward(maps.back()));
    const at::Tensor features = split->forward(maps.back().flatten(1));
    const at::Tensor of_others = features.narrow(1, material_features, other_features);
    const at::Tensor joined = join->forward(at::cat({wanted_features->forward(wanted), of_others}, 1));
    at::Tensor map = joined.reshape({-1, widths.back(), deepest, deepest});
    for (std::size_t i = 0; i < decoder.size(); ++i)
      map = at::cat({decoder[i]->forward(map), maps[widths.size() - 1 - i]}, 1);
    const at::Tensor image = drawn->forward(at::cat({last->forward(map), pictures}, 1)).sigmoid();
    return {regression->forward(features.narrow(1, 0, material_features)), image * pictures.narrow(1, 3, 1)};
  }

  int size, deepest;
  std::vector<torch::nn::Sequential> encoder, decoder;
  torch::nn::Sequential split{nullptr}, wanted_features{nullptr}, join{nullptr}, last{nullptr};
  torch::nn::Linear regression{nullptr};
  torch::nn::Conv2d drawn{nullptr};
  at::Tensor low, high;
};

EncoderDecoder::EncoderDecoder(int size, const MaterialRange& range)
    : modules_(std::make_shared<Modules>(size, range)) {}

Redrawn EncoderDecoder::operator()(const at::Tensor& pictures, const at::Tensor& wanted) const {
  PARTWISE_CHECK(pictures.dim(), ==, 4);
  PARTWISE_CHECK(pictures.size(1), ==, 4);
  for (const int side : {2, 3}) PARTWISE_CHECK(pictures.size(side), ==, modules_->size);
  PARTWISE_CHECK(wanted.size(1), ==, dsbrdf_size);
  return modules_->forward(pictures, wanted);
}

MaterialRange EncoderDecoder::range() const { return {modules_->low, modules_->high}; }
torch::nn::Module& EncoderDecoder::module() const { return *modules_; }

WeightsFile EncoderDecoder::weights() const { return {kind, nlohmann::ordered_json{{"size", modules_->size}}.dump()}; }

EncoderDecoder read_encoder_decoder(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(read_weights_settings(path, kind));
  EncoderDecoder network(json.value("size", smallest), {at::zeros({dsbrdf_size}), at::ones({dsbrdf_size})});
  read_weights(path, network.module());
  network.module().eval();
  return network;
}

Losses EncoderDecoderTask::losses(const EditBatch& batch, const EditingWeights& weights) const {
  const MaterialRange range = network_.range();
  const Redrawn found = network_(batch.pictures, range.scaled(batch.target_material));
  const at::Tensor target = display_values(batch.target).clamp_max(1);
  Losses result;
  if (weights.material > 0)
    result.add("material", weights.material, (found.material - range.scaled(batch.material)).square().mean(1));
  if (weights.pixel > 0) result.add("pixel", weights.pixel, object_mean((found.image - target).square(), batch.mask()));
  if (weights.perceptual > 0) {
    result.add("perceptual", weights.perceptual,
               reduced_perceptual_distance(features_, found.image, target, settings().perceptual_side));
  }
  return result;
}

}  // namespace partwise
