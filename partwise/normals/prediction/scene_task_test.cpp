#include "partwise/normals/prediction/scene_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/utils.h>

#include <nlohmann/json.hpp>

#include "partwise/base/error.h"
#include "partwise/editing/test_editing.h"
#include "partwise/normals/prediction/scene_training.h"
#include "partwise/normals/prediction/test_rooms.h"

namespace partwise {
namespace {

const SceneFrames& frames() {
  static const SceneFrames read({test::rooms_folder()}, 64);
  return read;
}

SceneNetworks networks(bool readers) {
  torch::manual_seed(1);
  return SceneNetworks({.width = 64, .readers = readers});
}

constexpr EditingWeights standalone{.normal = 1, .pixel = 0},
    combined{.normal = 1, .material = 0.1, .light = 0.1, .pixel = 20};

SceneTask task(const SceneNetworks& given, const EditingWeights& weights, bool given_truth = false) {
  return {given, frames(), frames(), {.stages = {weights}, .given = given_truth}};
}

TEST(SceneNetworks, AreReadAsTheyWereWritten) {
  const at::NoGradGuard no_gradient;
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  const at::Tensor pictures = frames().batch(1, 0, {0, 2, 2}, false).pictures;
  for (const bool readers : {false, true}) {
    const SceneNetworks given = networks(readers);
    given.module().eval();
    test::round_as_files_do(given.module());
    write_weights(path, given.weights(), given.module());
    const SceneNetworks read = read_scene_networks(path);
    EXPECT_EQ(read.settings().width, 64);
    EXPECT_TRUE(read.normals()(pictures).equal(given.normals()(pictures)));
    const NormalPredictor normals = read_normal_predictor(path);
    EXPECT_EQ(normals.settings().size, 64);
    EXPECT_TRUE(normals(pictures).equal(given.normals()(pictures)));
    if (!readers) {
      EXPECT_THROW(read.materials(pictures), CheckFailed);
      continue;
    }
    EXPECT_EQ(read.materials(pictures).sizes(), at::IntArrayRef({2, 32, 64, 64}));
    EXPECT_TRUE(read.materials(pictures).equal(given.materials(pictures)));
    EXPECT_EQ(read.log_radiance(pictures).sizes(), at::IntArrayRef({2, 3, 8, 16}));
    EXPECT_TRUE(read.log_radiance(pictures).equal(given.log_radiance(pictures)));
  }
  write_weights(path, {"oracle", "{}"}, networks(false).module());
  EXPECT_THROW(read_scene_networks(path), InputError);
}

TEST(SceneTask, LearnsAFewFramesByHeart) {
  for (const EditingWeights& weights : {standalone, combined}) {
    SceneTask given = task(networks(weights.pixel > 0), weights);
    const auto [first, last] = test::learnt_by_heart(given, 60);
    EXPECT_LT(last, 0.6 * first);
  }
}

TEST(SceneTask, ThePictureTeachesNormalsWithGivenMaterialAndLightOrReadOnes) {
  const auto taught = [&](const EditingWeights& weights, bool given) {
    const SceneNetworks of = networks(!given);
    SceneTask each = task(of, weights, given);
    const Losses losses = each.training_losses(0, 0, {0, 2, 2});
    losses.total.backward();
    double sum = 0;
    for (const at::Tensor& parameter : of.normals().module().parameters())
      if (parameter.grad().defined()) sum += parameter.grad().abs().sum().item<double>();
    return std::pair(losses.terms.size(), sum);
  };
  constexpr EditingWeights picture{.normal = 0, .material = 0, .light = 0, .pixel = 1};
  EXPECT_EQ(taught(combined, false).first, 4u);
  for (const bool given : {false, true}) {
    const auto [terms, gradient] = taught(picture, given);
    EXPECT_EQ(terms, 1u);
    EXPECT_GT(gradient, 1e-6);
  }
}

TEST(SceneTask, NeedsMaterialAndLightFromSomewhere) {
  EXPECT_THROW(task(networks(false), combined), CheckFailed);
  EXPECT_NO_THROW(task(networks(false), combined, true));
}

TEST(SceneTraining, GoesOnFromItselfAndFromOneOfSingleObjects) {
  const TestFolder folder;
  const auto configuration = [&](const nlohmann::json& changes) {
    nlohmann::json json = {{"network", "scenes"},
                           {"frames", test::rooms_folder().string()},
                           {"width", 64},
                           {"batch", 2},
                           {"stages", {{{"steps", 2}, {"normal", 1}, {"pixel", 5}, {"learning_rate", 1e-3}}}},
                           {"validation_batches", 1},
                           {"output", "out"}};
    if (!changes.is_null()) json.update(changes);
    write_file(folder.path() / "c.json", json.dump());
    return read_scene_training(folder.path() / "c.json");
  };
  const SceneTraining first = configuration({});
  EXPECT_TRUE(first.networks.readers);
  EXPECT_EQ(train_scenes(first, {}, false).step, 2);
  const NormalPredictor u(NormalPredictorSettings{});
  write_weights(folder.path() / "u.pt", u.weights(), u.module());
  for (const char* start : {"out/best.pt", "u.pt"}) {
    SceneTraining next = configuration({{"start", start}, {"given", true}});
    EXPECT_FALSE(next.networks.readers);
    next.loop.output = folder.path() / "next" / start;
    EXPECT_EQ(train_scenes(next, {}, false).step, 2);
  }
  for (const nlohmann::json& wrong : std::vector<nlohmann::json>{
           {{"width", 50}}, {{"channels", 20}}, {{"views", "a"}}, {{"frames", 3}}, {{"given", "yes"}}})
    EXPECT_THROW(configuration(wrong), InputError) << wrong.dump();
  EXPECT_THROW(train_scenes(configuration({{"frames", "nowhere"}}), {}, false), InputError);
}

}  // namespace
}  // namespace partwise
