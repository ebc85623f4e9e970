// Trainings on pictures that are drawn as they are needed (edit_samples.h): what their configurations share
// (docs/training.md), and how they run.
//
// Views come from the shards of data sets, materials and light are drawn anew for each batch, the loop is learning's.
// Errors: InputError with the file and the field's place; for views of another size than the network's.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "partwise/editing/sampled_task.h"
#include "partwise/learning/training_loop.h"

namespace partwise {

class JsonFields;

struct SampledTraining {
  int size = 128;  // pixels along a side of a view
  TrainingSettings loop;
  EditingTaskSettings task;
  EditSamplesSettings samples;
  std::vector<std::filesystem::path> views, validation_views;  // folders of shards
  std::vector<DsbrdfCoefficients> materials;
  std::vector<EnvironmentLight> lights;
  std::filesystem::path start;  // weights to start from; empty: random ones
};

// All fields but "network" and those of a network of its own. Files are named relative to the configuration's folder.
SampledTraining take_sampled_training(JsonFields& fields, const std::filesystem::path& path);

// Of a stage: the weights of the terms of its loss. Of a field: folders, named relative to `base`.
EditingWeights take_weights(JsonFields& stage);
std::vector<std::filesystem::path> take_folders(JsonFields& fields, const char* name,
                                                const std::filesystem::path& base);

// `make` is asked for the task once, after random numbers were seeded.
using SampledTaskMaker =
    std::function<std::unique_ptr<TrainingTask>(const EditSamples& training, const EditSamples& validation)>;
TrainingReport train_sampled(const SampledTraining& training, const SampledTaskMaker& make, const Rank& rank,
                             bool resume, const Progress& progress = {});

}  // namespace partwise
