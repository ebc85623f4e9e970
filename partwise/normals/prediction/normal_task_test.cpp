#include "partwise/normals/prediction/normal_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <ostream>
#include <string>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/editing/test_editing.h"

namespace partwise {
namespace {

constexpr NormalPredictorSettings u{.dropout = 0};
constexpr NormalPredictorSettings multi_branch{
    .architecture = NormalArchitecture::multi_branch, .channels = 32, .dropout = 0};

NormalPredictor predictor(const NormalPredictorSettings& settings) {
  torch::manual_seed(1);
  return NormalPredictor(settings);
}

NormalTask task(const NormalPredictor& given, const EditSamples& samples, const EditingWeights& weights,
                const std::optional<EditingNetworks>& readers = {}) {
  EditingTaskSettings settings;
  settings.stages = {weights};
  return {given, readers, samples, samples, settings};
}

constexpr EditingWeights standalone{.normal = 1, .pixel = 0}, combined{.normal = 1, .pixel = 20};

TEST(NormalPredictor, FindsUnitVectorsOnTheMask) {
  const at::NoGradGuard no_gradient;
  const EditBatch batch = test::samples(false).batch(0, {0, 2, 2});
  for (const NormalPredictorSettings& settings : {u, multi_branch}) {
    const NormalPredictor given = predictor(settings);
    given.module().eval();
    const at::Tensor lengths = given(batch.pictures).square().sum(1, true).sqrt();
    EXPECT_LT((lengths - batch.mask()).abs().max().item<double>(), 1e-4);
  }
  EXPECT_NO_THROW(predictor(u)(at::rand({1, 4, 64, 96})));
  EXPECT_THROW(predictor(multi_branch)(at::rand({1, 4, 64, 64})), CheckFailed);
}

TEST(NormalPredictor, BothWaysFindsOfMirrorImagesTheMirroredNormals) {
  const at::NoGradGuard no_gradient;
  const EditBatch batch = test::samples(false).batch(0, {0, 2, 2});
  const NormalPredictor given = predictor(u);
  given.module().eval();
  const at::Tensor found = given.both_ways(batch.pictures), mirrored = given.both_ways(batch.pictures.flip(3)).flip(3);
  EXPECT_LT((found.square().sum(1, true).sqrt() - batch.mask()).abs().max().item<double>(), 1e-4);
  const at::Tensor back = at::cat({-mirrored.narrow(1, 0, 1), mirrored.narrow(1, 1, 2)}, 1);
  EXPECT_LT((found - back).abs().max().item<double>(), 1e-5);
  EXPECT_GT((found - given(batch.pictures)).abs().max().item<double>(), 1e-3);
}

TEST(NormalPredictor, IsReadAsItWasWritten) {
  const at::NoGradGuard no_gradient;
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  const at::Tensor pictures = test::samples(false).batch(0, {0, 1, 1}).pictures;
  for (const NormalPredictorSettings& settings : {u, multi_branch}) {
    const NormalPredictor given = predictor(settings);
    given.module().eval();
    test::round_as_files_do(given.module());
    write_weights(path, given.weights(), given.module());
    const NormalPredictor read = read_normal_predictor(path);
    EXPECT_EQ(read.settings().architecture, settings.architecture);
    EXPECT_TRUE(read(pictures).equal(given(pictures)));
  }
  EXPECT_THROW(read_normal_weights(path, predictor(u)), InputError);
  NormalPredictorSettings wider = multi_branch;
  wider.channels = 48;
  EXPECT_THROW(read_normal_weights(path, predictor(wider)), InputError);
  write_weights(path, {"oracle", "{}"}, predictor(u).module());
  EXPECT_THROW(read_normal_predictor(path), InputError);
}

TEST(NormalPredictor, GoesOnFromTheNormalsOfEditing) {
  const at::NoGradGuard no_gradient;
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  torch::manual_seed(3);
  const EditingNetworks editing({.normal_channels = 32, .dropout = 0}, MaterialRange::of(test::materials()));
  editing.module().eval();
  test::round_as_files_do(editing.module());
  write_weights(path, editing.weights(), editing.module());
  const NormalPredictor given = predictor(multi_branch);
  read_normal_weights(path, given);
  given.module().eval();
  const at::Tensor pictures = test::samples(false).batch(0, {0, 1, 1}).pictures;
  EXPECT_TRUE(given(pictures).equal(editing.normals(pictures)));
}

TEST(NormalTask, TermsAreTheLossesThatTheyAreSaidToBe) {
  const EditSamples samples = test::samples(true, 4, 0.5);
  const NormalPredictor given = predictor(u);
  NormalTask both = task(given, samples, combined);
  const Losses losses = both.training_losses(0, 0, {0, 4, 4});
  ASSERT_EQ(losses.terms.size(), 2u);
  EXPECT_EQ(losses.terms[1].first, "pixel");
  EXPECT_NEAR(losses.total.item<double>(), losses.terms[0].second + 20 * losses.terms[1].second, 1e-5);
  const EditBatch batch = samples.batch(0, {0, 4, 4});
  const at::Tensor apart = (given(batch.pictures) - batch.normals).square().sum({1, 2, 3});
  EXPECT_NEAR(losses.terms[0].second, (apart / batch.mask().sum({1, 2, 3})).mean().item<double>(), 1e-4);
  EXPECT_EQ(task(given, samples, standalone).training_losses(0, 0, {0, 4, 4}).terms.size(), 1u);
}

// The rendered error alone moves normals, whether material and light are the true ones or read off the picture.
TEST(NormalTask, RenderingTeachesNormals) {
  const EditSamples samples = test::samples(false, 4, 0.5);
  torch::manual_seed(4);
  const EditingNetworks readers({.normal_channels = 32}, MaterialRange::of(test::materials()));
  std::vector<double> errors;
  for (const bool predicted : {false, true}) {
    const NormalPredictor given = predictor(u);
    NormalTask rendered = task(given, samples, {.normal = 0, .pixel = 1, .perceptual = 0.1},
                               predicted ? std::optional(readers) : std::nullopt);
    const Losses losses = rendered.training_losses(0, 0, {0, 4, 4});
    ASSERT_EQ(losses.terms.size(), 2u);
    losses.total.backward();
    for (const auto& each : given.module().named_parameters())
      EXPECT_GT(each.value().grad().abs().max().item<double>(), 0) << each.key();
    errors.push_back(losses.terms[0].second);
  }
  EXPECT_NE(errors[0], errors[1]);
  for (const auto& each : readers.module().named_parameters()) EXPECT_FALSE(each.value().grad().defined());
}

struct Case {
  const char* name;
  NormalPredictorSettings network;
  EditingWeights weights;
  friend void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }
};
class OneBatch : public testing::TestWithParam<Case> {};

// A network that cannot learn one batch by heart learns nothing.
TEST_P(OneBatch, IsLearntByHeart) {
  const EditSamples samples = test::samples(false, 4, 0.5);
  NormalTask alone = task(predictor(GetParam().network), samples, GetParam().weights);
  const auto [first, last] = test::learnt_by_heart(alone, 60);
  EXPECT_LT(last, first / 3);
}

INSTANTIATE_TEST_SUITE_P(Networks, OneBatch,
                         testing::Values(Case{"u_standalone", u, standalone}, Case{"u_combined", u, combined},
                                         Case{"multi_branch_standalone", multi_branch, standalone},
                                         Case{"multi_branch_combined", multi_branch, combined}),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace partwise
