#include "partwise/editing/editing_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/optim/adam.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/editing/encoder_decoder.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/editing/test_editing.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

EditingNetworks networks(double dropout = 0) {
  torch::manual_seed(1);
  return {{.dropout = dropout}, MaterialRange::of(test::materials())};
}

EditingTask task(const EditingNetworks& given, const EditSamples& samples, const EditingWeights& weights,
                 bool given_geometry = false) {
  EditingTaskSettings settings;
  settings.stages = {weights};
  settings.given_normals = settings.given_light = given_geometry;
  return {given, samples, samples, settings};
}

double gradient_of(torch::nn::Module& network, const std::string& start) {
  double sum = 0;
  for (const auto& each : network.named_parameters()) {
    if (each.key().rfind(start, 0) == 0 && each.value().grad().defined())
      sum += each.value().grad().square().sum().item<double>();
  }
  return std::sqrt(sum);
}

TEST(EditingNetworks, ShapesAndRanges) {
  EditingNetworks given = networks();
  given.module().eval();
  const EditBatch batch = test::samples(false).batch(0, {0, 2, 2});
  const PictureLayers found = given(batch.pictures);
  const at::Tensor lengths = found.normals.square().sum(1, true).sqrt();
  EXPECT_LT((lengths - batch.mask()).abs().max().item<double>(), 1e-4);
  EXPECT_EQ(found.material.sizes(), (std::vector<std::int64_t>{2, dsbrdf_size}));
  EXPECT_LE(found.material.abs().max().item<double>(), 1);
  EXPECT_EQ(found.log_radiance.sizes(), (std::vector<std::int64_t>{2, 3, 64, 128}));
  std::int64_t count = 0;
  for (const at::Tensor& each : given.module().parameters()) count += each.numel();
  EXPECT_LT(2 * count, 5'000'000);  // bytes in half precision
  EXPECT_THROW(given.normals(at::zeros({1, 4, 64, 64})), CheckFailed);
}

TEST(EditingNetworks, AreReadAsTheyWereWritten) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  EditingNetworks given = networks();
  given.module().eval();
  test::round_as_files_do(given.module());
  write_weights(path, given.weights(), given.module());
  const EditingNetworks read = read_editing_networks(path);
  const at::Tensor pictures = test::samples(false).batch(0, {0, 1, 1}).pictures;
  EXPECT_TRUE(read.scaled_material(pictures).equal(given.scaled_material(pictures)));
  EXPECT_TRUE(read.normals(pictures).equal(given.normals(pictures)));
  EXPECT_TRUE(read.range().high().equal(given.range().high()));
  write_weights(path, {"normals", "{}"}, given.module());
  EXPECT_THROW(read_editing_networks(path), InputError);
}

// Discs of a plain colour each, on black.
at::Tensor coloured_discs(const at::Tensor& colours) {
  constexpr int side = 128;
  const at::Tensor place = at::linspace(-1.2, 1.2, side).square();
  const at::Tensor disc = (place.unsqueeze(0) + place.unsqueeze(1) < 1).to(at::kFloat);
  return at::cat({colours, at::ones({colours.size(0), 1})}, 1).unsqueeze(2).unsqueeze(3) * disc;
}

// Whoever cannot learn to name a plain colour that nobody showed before will not learn materials and lights.
TEST(EditingNetworks, LearnColoursTheyHaveNotSeen) {
  EditingNetworks given = networks();
  torch::optim::Adam adam(given.module().parameters(), 1e-3);
  const auto losses = [&] {
    const at::Tensor colours = at::rand({4, 3});
    const at::Tensor pictures = coloured_discs(colours), wanted = colours - 0.5;
    const at::Tensor material = given.scaled_material(pictures).narrow(1, 0, 3);
    const at::Tensor light = given.log_radiance(pictures).mean({2, 3});
    return std::pair{(material - wanted).square().mean(), (light - wanted).square().mean()};
  };
  for (int step = 0; step < 150; ++step) {
    adam.zero_grad();
    const auto [material, light] = losses();
    (material + light).backward();
    adam.step();
  }
  const at::NoGradGuard no_gradient;
  const auto [material, light] = losses();
  const double of_the_mean = 1.0 / 12;
  EXPECT_LT(material.item<double>(), 0.1 * of_the_mean);
  EXPECT_LT(light.item<double>(), 0.1 * of_the_mean);
}

TEST(EditingTask, EveryTermReachesItsNetworks) {
  const EditSamples samples = test::samples(true);
  const Rows rows{0, 4, 4};
  EditingNetworks given = networks();
  EditingTask all = task(given, samples, {.normal = 0, .material = 0, .light = 0, .pixel = 1, .perceptual = 1});
  const Losses losses = all.training_losses(0, 0, rows);
  ASSERT_EQ(losses.terms.size(), 2u);
  EXPECT_NEAR(losses.total.item<double>(), losses.terms[0].second + losses.terms[1].second, 1e-5);
  losses.total.backward();
  for (const char* part : {"normals", "material", "light"}) EXPECT_GT(gradient_of(given.module(), part), 0) << part;
}

TEST(EditingTask, WhatIsGivenIsNotPredicted) {
  const EditSamples samples = test::samples(true);
  EditingNetworks given = networks();
  EditingTask material =
      task(given, samples, {.normal = 1, .material = 1, .light = 1, .pixel = 1, .perceptual = 0}, true);
  const Losses losses = material.training_losses(0, 0, {0, 4, 4});
  ASSERT_EQ(losses.terms.size(), 2u);
  EXPECT_EQ(losses.terms[0].first, "material");
  EXPECT_EQ(losses.terms[1].first, "pixel");
  losses.total.backward();
  EXPECT_GT(gradient_of(given.module(), "material"), 0);
  EXPECT_EQ(gradient_of(given.module(), "normals"), 0);
  EXPECT_EQ(gradient_of(given.module(), "light"), 0);
}

// What processes that share a batch have in the mean is what one has.
TEST(EditingTask, SharesOfABatchHaveItsGradientInTheMean) {
  const EditSamples samples = test::samples(true);
  const EditingWeights weights{.perceptual = 0};
  std::vector<at::Tensor> whole, shared;
  for (std::vector<at::Tensor>* gradients : {&whole, &shared}) {
    EditingNetworks given = networks(0.3);
    EditingTask joint = task(given, samples, weights);
    const bool one = gradients == &whole;
    for (const Rows& rows : one ? std::vector{Rows{0, 4, 4}} : std::vector{Rows{0, 2, 4}, Rows{2, 2, 4}}) {
      torch::manual_seed(9);
      take_rows(given.module(), rows);
      (joint.training_losses(0, 0, rows).total / (one ? 1 : 2)).backward();
    }
    for (const at::Tensor& each : given.module().parameters()) gradients->push_back(each.grad());
  }
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    difference += (whole[i] - shared[i]).square().sum().item<double>();
    size += whole[i].square().sum().item<double>();
  }
  EXPECT_LT(std::sqrt(difference), 1e-4 * std::sqrt(size));
}

// A network that cannot learn one batch by heart learns nothing.
struct Term {
  const char* name;
  EditingWeights weights;
  friend void PrintTo(const Term& term, std::ostream* out) { *out << term.name; }
};
class OneBatch : public testing::TestWithParam<Term> {};

TEST_P(OneBatch, IsLearntByHeart) {
  const EditSamples samples = test::samples(false);
  EditingTask alone = task(networks(), samples, GetParam().weights);
  const auto [first, last] = test::learnt_by_heart(alone);
  EXPECT_LT(last, first / 3);
}

INSTANTIATE_TEST_SUITE_P(Networks, OneBatch,
                         testing::Values(Term{"normals", {1, 0, 0, 0, 0}}, Term{"material", {0, 1, 0, 0, 0}},
                                         Term{"light", {0, 0, 1, 0, 0}}, Term{"joint", {0, 0, 0, 1, 0}}),
                         [](const auto& each) { return each.param.name; });

TEST(EncoderDecoder, LearnsABatchByHeartAndIsReadAsItWasWritten) {
  const EditSamples samples = test::samples(false);
  torch::manual_seed(1);
  const EncoderDecoder network(128, MaterialRange::of(test::materials()));
  EditingTaskSettings settings;
  settings.stages = {{.normal = 0, .material = 1, .light = 0, .pixel = 10, .perceptual = 1}};
  EncoderDecoderTask task(network, samples, samples, settings);
  const auto [first, last] = test::learnt_by_heart(task);
  EXPECT_LT(last, first / 3);
  network.module().eval();
  test::round_as_files_do(network.module());
  const TestFolder folder;
  write_weights(folder.path() / "w.pt", network.weights(), network.module());
  const EncoderDecoder read = read_encoder_decoder(folder.path() / "w.pt");
  const EditBatch batch = samples.batch(0, {0, 1, 1});
  const at::Tensor wanted = network.range().scaled(batch.target_material);
  EXPECT_TRUE(read(batch.pictures, wanted).image.equal(network(batch.pictures, wanted).image));
  EXPECT_THROW(read_editing_networks(folder.path() / "w.pt"), InputError);
}

TEST(ExposedAs, UndoesWhatMadeAnImageDarkerOverItsObject) {
  torch::manual_seed(3);
  const at::Tensor truths = torch::rand({2, 3, 8, 8}) + 10, stops = torch::tensor({0.25, 0.5}).reshape({2, 1, 1, 1});
  at::Tensor mask = at::zeros({2, 1, 8, 8});
  mask.narrow(2, 2, 4).fill_(1);
  at::Tensor images = truths * stops;
  images.narrow(2, 7, 1).fill_(100);  // off the object: does not count
  const at::Tensor same = exposed_as(images, truths, mask);
  EXPECT_LT(((same / truths - 1) * mask).abs().max().item<double>(), 0.01);
}

TEST(ReducedLight, KeepsEnergy) {
  torch::manual_seed(2);
  const at::Tensor radiance = torch::rand({1, 3, 64, 128}), reduced = reduced_light(radiance, 32);
  ASSERT_EQ(reduced.sizes(), (std::vector<std::int64_t>{1, 3, 16, 32}));
  const auto energy = [](const at::Tensor& map) {
    double sum = 0;
    for (std::int64_t y = 0; y < map.size(2); ++y)
      sum += map[0][0][y].sum().item<double>() * equirectangular_solid_angle(static_cast<int>(y),
                                                                             static_cast<int>(map.size(3)),
                                                                             static_cast<int>(map.size(2)));
    return sum;
  };
  EXPECT_NEAR(energy(reduced), energy(radiance), 1e-3);
  EXPECT_LT((reduced_light(at::ones({1, 3, 64, 128}), 16) - 1).abs().max().item<double>(), 1e-5);
}

}  // namespace
}  // namespace partwise
