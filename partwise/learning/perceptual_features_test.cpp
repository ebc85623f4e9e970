#include "partwise/learning/perceptual_features.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

class Perceptual : public testing::Test {
 protected:
  PerceptualFeatures features_ = PerceptualFeatures::shipped();
};

TEST_F(Perceptual, FeaturesAreAlive) {
  torch::manual_seed(1);
  at::Tensor noise = at::avg_pool2d(torch::rand({1, 3, 192, 192}), {3, 3});
  const std::vector<at::Tensor> found = features_(noise);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].sizes(), (std::vector<std::int64_t>{1, 64, 64, 64}));
  EXPECT_EQ(found[1].sizes(), (std::vector<std::int64_t>{1, 128, 32, 32}));
  for (const at::Tensor& each : found) {
    const at::Tensor of_channels = (each > 0).to(at::kFloat).mean({0, 2, 3});
    EXPECT_GT(of_channels.min().item<double>(), 0);  // no channel is dead
    EXPECT_GT(of_channels.mean().item<double>(), 0.25);
    EXPECT_LT(of_channels.mean().item<double>(), 0.85);
  }
}

// Means over the places of some channels, from the weights as published, unrounded, by plain loops in another language.
// Mirrored kernels, red first, tiles read in another order or biases of other channels each move one of them by 0.5 or
// more; half precision moves none by more than 0.05.
TEST_F(Perceptual, FeaturesAreThoseOfThePublishedWeights) {
  const at::Tensor places = at::arange(64, at::kFloat).reshape({1, 1, 8, 8});
  const at::Tensor picture = at::remainder(at::cat({places, places * 2, places * 3}, 1) * 37, 256) / 255;
  const std::vector<at::Tensor> found = features_(picture);
  const std::vector<std::vector<double>> expected = {
      {287.242, 177.229, 169.291, 149.699, 105.938, 256.728, 92.695, 133.380},  // channels 0, 8, 16, ...
      {258.631, 255.844, 0, 183.883, 70.972, 0, 0, 56.862}};                    // channels 0, 16, 32, ...
  for (std::size_t layer = 0; layer < expected.size(); ++layer) {
    const at::Tensor of_channels = found[layer].mean({0, 2, 3});
    for (std::int64_t i = 0; i < 8; ++i) {
      const std::int64_t channel = i * of_channels.size(0) / 8;
      EXPECT_NEAR(of_channels[channel].item<double>(), expected[layer][static_cast<std::size_t>(i)], 0.1) << channel;
    }
  }
}

// Some channels of the first layers are known to answer to edges alone: a flat picture leaves most of them silent
// beside a picture with edges, and where the edges lie is where answers are.
TEST_F(Perceptual, EdgesAreSeenWhereTheyAre) {
  at::Tensor step = at::zeros({1, 3, 32, 32});
  step.narrow(3, 16, 16).fill_(1);
  const at::Tensor found = features_(step)[0], flat = features_(at::zeros({1, 3, 32, 32}))[0];
  const at::Tensor left = (found - flat).abs().mean(1)[0];  // the left half is black in both
  EXPECT_LT(left.narrow(0, 4, 24).narrow(1, 4, 8).max().item<double>(), 1e-3);
  EXPECT_GT(left.narrow(0, 4, 24).narrow(1, 15, 2).mean().item<double>(), 1);
}

TEST_F(Perceptual, DistanceGrowsWithBlurAndIsZeroToItself) {
  torch::manual_seed(2);
  const at::Tensor sharp = torch::rand({2, 3, 64, 64});
  double before = 0;
  for (const std::int64_t radius : {0, 1, 2, 3}) {
    const std::int64_t width = 2 * radius + 1;
    const at::Tensor blurred = at::avg_pool2d(sharp, {width, width}, {1, 1}, {radius, radius});
    const at::Tensor distance = perceptual_distance(features_, blurred, sharp);
    ASSERT_EQ(distance.sizes(), (std::vector<std::int64_t>{2}));
    if (radius == 0) {
      EXPECT_EQ(distance.max().item<double>(), 0);
    } else {
      EXPECT_GT(distance.min().item<double>(), before);
    }
    before = distance.max().item<double>() * (radius == 0 ? 1 : 0.9);
  }
}

TEST_F(Perceptual, EachPictureStandsAlone) {
  torch::manual_seed(3);
  const at::Tensor a = torch::rand({3, 3, 16, 16}), b = torch::rand({3, 3, 16, 16});
  const at::Tensor all = perceptual_distance(features_, a, b);
  for (int i = 0; i < 3; ++i) {
    const at::Tensor one = perceptual_distance(features_, a.narrow(0, i, 1), b.narrow(0, i, 1));
    EXPECT_NEAR(one.item<double>(), all[i].item<double>(), 1e-5 * all[i].item<double>());
  }
}

TEST_F(Perceptual, GradientAgainstDifferences) {
  torch::manual_seed(4);
  at::Tensor a = torch::rand({1, 3, 8, 8}, at::kDouble).requires_grad_();
  const at::Tensor b = torch::rand({1, 3, 8, 8}, at::kDouble);
  perceptual_distance(features_, a, b).sum().backward();
  const at::NoGradGuard no_gradient;
  for (const std::int64_t i : {0, 37, 100, 191}) {
    const auto moved = [&](double step) {
      at::Tensor copy = a.clone();
      copy.view({-1})[i] += step;
      return perceptual_distance(features_, copy, b).sum().item<double>();
    };
    const double slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
    EXPECT_NEAR(a.grad().view({-1})[i].item<double>(), slope, 1e-5 * std::abs(slope) + 1e-10);
  }
}

TEST_F(Perceptual, FilesThatAreNot) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  const std::string whole = read_bytes(std::filesystem::path(PARTWISE_TEST_DATA) / "models/networks/vgg16_start.pt");
  for (const std::string& bytes : {std::string(), std::string("PK\3\4 none"), whole.substr(0, whole.size() / 2),
                                   whole.substr(0, whole.size() - 5)}) {
    write_file(path, bytes);
    EXPECT_THROW(PerceptualFeatures{path}, InputError) << bytes.size();
  }
  EXPECT_THROW(PerceptualFeatures{folder.path() / "none.pt"}, InputError);
}

TEST_F(Perceptual, RefusesOtherShapes) {
  const at::Tensor one = at::zeros({1, 3, 8, 8});
  for (const at::Tensor& other : {at::zeros({3, 8, 8}), at::zeros({1, 4, 8, 8}), at::zeros({1, 3, 3, 8})}) {
    EXPECT_THROW(features_(other), CheckFailed);
  }
  for (const at::Tensor& other : {at::zeros({2, 3, 8, 8}), at::zeros({1, 3, 8, 16}), one.to(at::kDouble)}) {
    EXPECT_THROW(perceptual_distance(features_, one, other), CheckFailed);
    EXPECT_THROW(perceptual_distance(features_, other, one), CheckFailed);
  }
}

}  // namespace
}  // namespace partwise
