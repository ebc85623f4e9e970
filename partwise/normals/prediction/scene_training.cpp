#include "partwise/normals/prediction/scene_training.h"

#include <ATen/core/grad_mode.h>
#include <torch/nn/module.h>
#include <torch/utils.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "partwise/base/error.h"
#include "partwise/editing/sampled_training.h"
#include "partwise/learning/training_fields.h"

namespace partwise {
namespace {

// Networks of scenes with the same readers, or any network for normals of this architecture.
void start_from(const std::filesystem::path& path, const SceneNetworks& networks) {
  if (read_weights_header(path).kind == SceneNetworks::kind) {
    const SceneNetworks other = read_scene_networks(path);
    if (other.settings().readers && networks.settings().readers &&
        other.settings().channels == networks.settings().channels)
      return read_weights(path, networks.module());
  }
  read_normal_weights(path, networks.normals());
}

}  // namespace

SceneTraining read_scene_training(const std::filesystem::path& path, std::uint64_t seed) {
  const nlohmann::json whole = read_training_file(path, seed);
  JsonFields fields(path.string(), "", whole, training_page);
  fields.need("network");
  const std::filesystem::path base = path.parent_path();
  SceneTraining result;
  result.loop = take_training_settings(fields);
  for (JsonFields& stage : take_stages(fields, path.string())) {
    result.loop.stages.push_back(take_stage(stage));
    result.task.stages.push_back(take_weights(stage));
    stage.refuse_others();
  }
  result.task.given = fields.truth("given", result.task.given);
  const bool pictures =
      std::ranges::any_of(result.task.stages, [](const EditingWeights& each) { return each.pixel > 0; });
  result.networks.readers = pictures && !result.task.given;
  result.networks.width = fields.whole("width", result.networks.width, 32, 1024);
  if (result.networks.width % 32 != 0) fields.refuse("width", "is no multiple of 32", "give one");
  result.networks.channels = fields.whole("channels", result.networks.channels, 16, 512);
  if (result.networks.channels % 16 != 0) fields.refuse("channels", "is no multiple of 16", "give one");
  result.task.validation_batches = fields.whole("validation_batches", 8, 0, 100000);
  result.task.seed = result.loop.seed;
  result.frames = take_folders(fields, "frames", base);
  result.validation_frames =
      fields.has("validation_frames") ? take_folders(fields, "validation_frames", base) : result.frames;
  if (fields.has("start")) result.start = base / fields.text("start");
  if (fields.has("output")) result.loop.output = base / fields.text("output");
  fields.refuse_others();
  result.loop.configuration = whole.dump(2) + "\n";
  return result;
}

TrainingReport train_scenes(const SceneTraining& training, const Rank& rank, bool resume, const Progress& progress) {
  const SceneFrames frames(training.frames, training.networks.width, progress),
      validation(training.validation_frames, training.networks.width, progress);
  torch::manual_seed(training.loop.seed);
  const SceneNetworks networks(training.networks);
  if (!training.start.empty()) start_from(training.start, networks);
  SceneTask task(networks, frames, validation, training.task);
  return train(task, training.loop, rank, resume, progress);
}

}  // namespace partwise
