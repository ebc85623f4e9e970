#include "partwise/learning/perceptual_features.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <fmt/format.h>

#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/learning/checkpoint.h"
#include "partwise/learning/vgg16_start.h"

namespace partwise {
namespace {

constexpr std::array<double, 3> mean_colour = {103.939, 116.779,
                                               123.68};  // blue, green, red, of what it was trained on

}  // namespace

Vgg16Start::Vgg16Start() {
  for (std::size_t i = 0; i < kernels.size(); ++i) {
    kernels[i] = register_buffer(fmt::format("kernel{}", i), at::zeros({channels[i + 1], channels[i], 3, 3}));
    biases[i] = register_buffer(fmt::format("bias{}", i), at::zeros({channels[i + 1]}));
  }
}

struct PerceptualFeatures::Convolutions {
  Vgg16Start weights;

  at::Tensor apply(std::size_t i, const at::Tensor& maps) const {
    const auto type = maps.scalar_type();
    return at::conv2d(maps, weights.kernels[i].to(type), weights.biases[i].to(type), /*stride=*/1, /*padding=*/1)
        .relu();
  }
};

PerceptualFeatures PerceptualFeatures::shipped() {
  return PerceptualFeatures(shared_file("models/networks/vgg16_start.pt"));
}

PerceptualFeatures::PerceptualFeatures(const std::filesystem::path& path) {
  read_weights_settings(path, vgg16_start_kind);
  auto convolutions = std::make_shared<Convolutions>();
  read_weights(path, convolutions->weights);
  convolutions_ = std::move(convolutions);
}

std::vector<at::Tensor> PerceptualFeatures::operator()(const at::Tensor& pictures) const {
  PARTWISE_CHECK(pictures.dim(), ==, 4);
  PARTWISE_CHECK(pictures.size(1), ==, 3);
  for (const int side : {2, 3}) PARTWISE_CHECK(pictures.size(side), >=, 4);
  const at::Tensor mean = at::tensor(at::ArrayRef<double>(mean_colour.data(), mean_colour.size()), pictures.options());
  const at::Tensor blue_first = pictures.flip(1) * 255 - mean.reshape({1, 3, 1, 1});
  const at::Tensor first = convolutions_->apply(1, convolutions_->apply(0, blue_first));
  return {first, convolutions_->apply(3, convolutions_->apply(2, at::max_pool2d(first, {2, 2})))};
}

at::Tensor perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b) {
  PARTWISE_CHECK(a.sizes() == b.sizes(), ==, true);
  PARTWISE_CHECK(a.scalar_type() == b.scalar_type(), ==, true);
  const std::vector<at::Tensor> of_a = features(a), of_b = features(b);
  at::Tensor sum = at::zeros({a.size(0)}, a.options());
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    sum = sum + ((of_a[i] - of_b[i]) / feature_scale).square().mean({1, 2, 3});
  }
  return sum;
}

}  // namespace partwise
