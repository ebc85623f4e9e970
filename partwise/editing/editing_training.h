// Training of the networks of editing from a configuration in JSON (docs/training.md).
//
// Pictures are those of sampled_training.h, the objective is that of editing_task.h. Errors: InputError with the file
// and the field's place.
#pragma once

#include "partwise/editing/editing_networks.h"
#include "partwise/editing/sampled_training.h"

namespace partwise {

enum class EditingKind { layers, encoder_decoder };  // editing_networks.h, encoder_decoder.h

struct EditingTraining : SampledTraining {
  EditingKind kind = EditingKind::layers;
  EditingNetworksSettings networks;
};

// `seed`, unless it is 0, goes before the configuration's.
EditingTraining read_editing_training(const std::filesystem::path& path, std::uint64_t seed = 0);

TrainingReport train_editing(const EditingTraining& training, const Rank& rank, bool resume,
                             const Progress& progress = {});

}  // namespace partwise
