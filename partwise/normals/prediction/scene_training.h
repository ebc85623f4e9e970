// Training of networks for normals of scenes from a configuration in JSON (docs/training.md, "network": "scenes").
//
// Pictures are those of scene_frames.h, the objective is that of scene_task.h. Errors: InputError with the file and the
// field's place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "partwise/learning/training_loop.h"
#include "partwise/normals/prediction/scene_task.h"

namespace partwise {

struct SceneTraining {
  SceneNetworksSettings networks;
  TrainingSettings loop;
  SceneTaskSettings task;
  std::vector<std::filesystem::path> frames, validation_frames;  // folders
  std::filesystem::path start;                                   // weights to start from; empty: random ones
};

// `seed`, unless it is 0, goes before the configuration's.
SceneTraining read_scene_training(const std::filesystem::path& path, std::uint64_t seed = 0);

TrainingReport train_scenes(const SceneTraining& training, const Rank& rank, bool resume,
                            const Progress& progress = {});

}  // namespace partwise
