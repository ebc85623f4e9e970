// Views, materials and light that the tests of this room share. Tests only; not installed.
#pragma once

#include <torch/nn/module.h>
#include <torch/optim/adam.h>
#include <torch/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/synthesis/dataset.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/test_folder.h"
#include "partwise/editing/edit_samples.h"
#include "partwise/learning/training_task.h"

namespace partwise::test {

// A few views of shipped models on disk, made once a test program.
inline const std::filesystem::path& views_folder() {
  static const TestFolder folder;
  static const bool made = [] {
    const std::filesystem::path config = folder.path() / "views.json";
    const std::string models = std::string(PARTWISE_TEST_DATA) + "/data/models/";
    write_file(config,
               R"({"shapes": [")" + models + R"(chair.off", ")" + models + R"(toy_car.glb"], "materials": "training",
      "lights": ["studio"], "light_size": [16, 8], "map_size": 8, "parts": "components", "format": "png", "views": 1, "images": 6, "images_per_shard": 4})");
    DatasetConfig data = read_dataset_config(config);
    data.output = folder.path() / "views";
    make_dataset(data, {});
    return true;
  }();
  static const std::filesystem::path path = folder.path() / "views";
  return made ? path : path;
}

inline const StoredViews& views() {
  static const StoredViews stored({views_folder()});
  return stored;
}

inline std::vector<DsbrdfCoefficients> materials() {
  std::vector<DsbrdfCoefficients> result;
  for (const char* name : {"alum-bronze", "blue-rubber", "cherry-235", "green-fabric", "pvc", "red-plastic"})
    result.push_back(shipped_material(name).brdf.coefficients());
  return result;
}

inline void round_as_files_do(torch::nn::Module& network) {
  const at::NoGradGuard no_gradient;
  for (at::Tensor& each : network.parameters()) each.copy_(each.to(at::kHalf));
}

// The loss of one batch before training on it, and after.
inline std::pair<double, double> learnt_by_heart(TrainingTask& task, int steps = 30) {
  torch::optim::Adam optimiser(task.network().parameters(), torch::optim::AdamOptions(3e-3));
  double first = 0, last = 0;
  for (int step = 0; step < steps; ++step) {
    optimiser.zero_grad();
    const Losses losses = task.training_losses(0, 0, {0, 2, 2});
    losses.total.backward();
    optimiser.step();
    last = losses.total.item<double>();
    if (step == 0) first = last;
  }
  return {first, last};
}

inline EditSamples samples(bool varied, int group = 4, double parts = 0) {
  return {views(),
          materials(),
          {shipped_light("studio"), shipped_light("park")},
          {.seed = 5, .group = group, .varied = varied, .parts = parts}};
}

}  // namespace partwise::test
