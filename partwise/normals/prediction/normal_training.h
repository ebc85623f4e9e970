// Training of a network for normals from a configuration in JSON (docs/training.md, "network": "normals").
//
// Pictures are those of editing/sampled_training.h, the objective is that of normal_task.h. Errors: InputError with the
// file and the field's place.
#pragma once

#include <cstdint>
#include <filesystem>

#include "partwise/editing/sampled_training.h"
#include "partwise/normals/prediction/normal_predictor.h"

namespace partwise {

struct NormalTraining : SampledTraining {
  NormalPredictorSettings network;
  std::filesystem::path readers;  // networks of editing for material and light; empty: the true ones
};

// `seed`, unless it is 0, goes before the configuration's.
NormalTraining read_normal_training(const std::filesystem::path& path, std::uint64_t seed = 0);

TrainingReport train_normals(const NormalTraining& training, const Rank& rank, bool resume,
                             const Progress& progress = {});

}  // namespace partwise
