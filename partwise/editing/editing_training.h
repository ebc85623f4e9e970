// Training of the networks of editing from a configuration in JSON (docs/training.md).
//
// Views come from the shards of data sets, materials and light are drawn anew for each batch (edit_samples.h); the
// objective is that of editing_task.h, the loop learning's. Errors: InputError with the file and the field's place.
#pragma once

#include <string>
#include <vector>

#include "partwise/editing/editing_networks.h"
#include "partwise/editing/sampled_task.h"
#include "partwise/learning/training_loop.h"

namespace partwise {

enum class EditingKind { layers, encoder_decoder };  // editing_networks.h, encoder_decoder.h

struct EditingTraining {
  EditingKind kind = EditingKind::layers;
  EditingNetworksSettings networks;
  TrainingSettings loop;
  EditingTaskSettings task;
  EditSamplesSettings samples;
  std::vector<std::filesystem::path> views, validation_views;  // folders of shards
  std::vector<DsbrdfCoefficients> materials;
  std::vector<EnvironmentLight> lights;
  std::filesystem::path start;  // weights to start from; empty: random ones
};

// `seed`, unless it is 0, goes before the configuration's.
EditingTraining read_editing_training(const std::filesystem::path& path, std::uint64_t seed = 0);

TrainingReport train_editing(const EditingTraining& training, const Rank& rank, bool resume,
                             const Progress& progress = {});

}  // namespace partwise
