#include "partwise/normals/prediction/u_network.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <string>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

TEST(UNetwork, TakesAnySizeThat32Divides) {
  const at::NoGradGuard no_gradient;
  const UNetwork network({.in = 4, .out = 32});
  for (const auto& [height, width] : {std::pair{32, 32}, {96, 64}, {160, 128}}) {
    const at::Tensor found = network(at::rand({2, 4, height, width}));
    EXPECT_EQ(found.sizes(), (std::vector<std::int64_t>{2, 32, height, width}));
  }
  EXPECT_THROW(network(at::rand({1, 4, 48, 64})), CheckFailed);
  EXPECT_THROW(network(at::rand({1, 3, 64, 64})), CheckFailed);
  EXPECT_THROW(network(at::rand({4, 64, 64})), CheckFailed);
  EXPECT_THROW(UNetwork({.channels = 24}), CheckFailed);
}

// What the header says of its size, counted by the layers' shapes.
TEST(UNetwork, IsAsLargeAsItSays) {
  const UNetwork network;
  std::int64_t count = 0, kernels = 0;
  double multiply_adds = 0;  // a pixel
  for (const auto& each : network.module()->named_parameters()) {
    count += each.value().numel();
    if (each.value().dim() != 4) continue;
    ++kernels;
    const int level = each.key().at(each.key().find_first_of("01234")) - '0';
    multiply_adds += static_cast<double>(each.value().numel()) / static_cast<double>(1 << (2 * level));
  }
  EXPECT_EQ(kernels, 26);  // thirteen down, thirteen up
  EXPECT_NEAR(static_cast<double>(count), 1.04e6, 0.005e6);
  EXPECT_NEAR(multiply_adds, 24.8e3, 0.05e3);
}

// A row does not depend on its neighbours, as learning/network_blocks.h promises.
TEST(UNetwork, RowsStandAlone) {
  const at::NoGradGuard no_gradient;
  torch::manual_seed(1);
  const UNetwork network;
  const at::Tensor maps = at::rand({3, 4, 64, 64}), all = network(maps);
  EXPECT_LT((network(maps.narrow(0, 1, 1)) - all.narrow(0, 1, 1)).abs().max().item<double>(), 1e-4);
}

TEST(UNetwork, GradientsMeetFiniteDifferences) {
  torch::manual_seed(2);
  const UNetwork network;
  network.module()->to(at::kDouble);
  const at::Tensor maps = at::rand({1, 4, 64, 64}, at::kDouble), factors = at::randn({1, 3, 64, 64}, at::kDouble);
  const auto value = [&] { return (network(maps) * factors).sum(); };
  value().backward();
  const at::NoGradGuard no_gradient;
  constexpr double step = 1e-6;  // small beside the distance to where a rectifier or a pooling changes its mind
  for (const auto& each : network.module()->named_parameters()) {
    at::Tensor parameter = each.value();
    ASSERT_TRUE(parameter.grad().defined()) << each.key();
    const at::Tensor direction = at::randn_like(parameter) / std::sqrt(static_cast<double>(parameter.numel()));
    const double expected = (parameter.grad() * direction).sum().item<double>();
    parameter.add_(direction, step);
    const double above = value().item<double>();
    parameter.sub_(direction, 2 * step);
    const double below = value().item<double>();
    parameter.add_(direction, step);
    EXPECT_NEAR((above - below) / (2 * step), expected, 1e-3 * std::abs(expected) + 1e-3) << each.key();
  }
}

}  // namespace
}  // namespace partwise
