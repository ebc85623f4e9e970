#include "partwise/learning/network_blocks.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/nn/init.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/normalization.h>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr int channels_a_group = 8;

void add_normalised_rectifier(torch::nn::Sequential& layers, int channels) {
  PARTWISE_CHECK(channels % channels_a_group, ==, 0);
  layers->push_back(torch::nn::GroupNorm(channels / channels_a_group, channels));
  layers->push_back(torch::nn::ReLU());
}

// What passes neither grows nor fades from layer to layer (He, Zhang, Ren and Sun 2015, "Delving deep into
// rectifiers").
template <typename Layer>
void start_for_rectifier(Layer& layer) {
  torch::nn::init::kaiming_normal_(layer.weight, 0, torch::kFanIn, torch::kReLU);
  torch::nn::init::zeros_(layer.bias);
}

}  // namespace

at::Tensor RowDropoutImpl::forward(const at::Tensor& values) {
  if (!is_training() || share_ == 0) return values;
  PARTWISE_CHECK(values.size(0), ==, rows_.count);
  const at::Tensor kept = at::bernoulli(at::full({rows_.all, values.size(1)}, 1 - share_, values.options()));
  return values * kept.narrow(0, rows_.first, rows_.count) / (1 - share_);
}

void take_rows(torch::nn::Module& network, const Rows& rows) {
  for (const auto& each : network.modules()) {
    if (auto* dropout = each->as<RowDropoutImpl>()) dropout->take(rows);
  }
}

torch::nn::Sequential convolution(int from, int to, int kernel, int stride) {
  torch::nn::Sequential layers(
      torch::nn::Conv2d(torch::nn::Conv2dOptions(from, to, kernel).stride(stride).padding(kernel / 2).bias(false)));
  add_normalised_rectifier(layers, to);
  return layers;
}

torch::nn::Sequential halving_convolution(int from, int to, int kernel) {
  torch::nn::Conv2d convolution(torch::nn::Conv2dOptions(from, to, kernel).stride(2).padding(kernel / 2));
  start_for_rectifier(*convolution);
  return torch::nn::Sequential(convolution, torch::nn::ReLU());
}

torch::nn::Sequential halving_convolutions(int from, const std::vector<int>& channels, Normalisation normalisation) {
  torch::nn::Sequential layers;
  for (const int to : channels) {
    const int kernel = layers->is_empty() ? 5 : 3;
    layers->extend(normalisation == Normalisation::groups ? *convolution(from, to, kernel, 2)
                                                          : *halving_convolution(from, to, kernel));
    from = to;
  }
  return layers;
}

torch::nn::Sequential doubling_convolution(int from, int to) {
  torch::nn::Sequential layers(
      torch::nn::ConvTranspose2d(torch::nn::ConvTranspose2dOptions(from, to, 4).stride(2).padding(1).bias(false)));
  add_normalised_rectifier(layers, to);
  return layers;
}

at::Tensor unit_vectors(const at::Tensor& vectors) { return vectors / (vectors.square().sum(1, true) + 1e-12).sqrt(); }

torch::nn::Sequential connected(int from, int to, double dropout) {
  torch::nn::Linear linear(from, to);
  start_for_rectifier(*linear);
  return torch::nn::Sequential(linear, torch::nn::ReLU(), RowDropout(dropout));
}

}  // namespace partwise
