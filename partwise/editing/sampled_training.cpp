#include "partwise/editing/sampled_training.h"

#include <fmt/format.h>
#include <torch/utils.h>

#include <nlohmann/json.hpp>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/learning/training_fields.h"

namespace partwise {
namespace {

std::vector<DsbrdfCoefficients> take_materials(JsonFields& fields, const std::filesystem::path& base) {
  std::vector<std::string> names;
  const nlohmann::json& given = fields.need("materials");
  if (given == "training")
    names = training_materials();
  else if (given == "all")
    names = shipped_materials();
  else
    names = fields.texts("materials");
  std::vector<DsbrdfCoefficients> result;
  for (const std::string& name : names) {
    const auto material = std::dynamic_pointer_cast<const Dsbrdf>(find_material(name, base));
    if (material == nullptr)
      fields.refuse("materials", fmt::format("\"{}\" is measured, not fitted", name),
                    "fit it with partwise material fit");
    result.push_back(material->coefficients());
  }
  return result;
}

std::vector<EnvironmentLight> take_lights(JsonFields& fields, const std::filesystem::path& base) {
  const std::vector<std::string> names = fields.need("lights") == "all" ? shipped_lights() : fields.texts("lights");
  std::vector<EnvironmentLight> result;
  result.reserve(names.size());
  for (const std::string& name : names) result.push_back(named_light(name, base));
  return result;
}

}  // namespace

EditingWeights take_weights(JsonFields& stage) {
  EditingWeights weights;
  for (const auto& [name, weight] : {std::pair{"normal", &weights.normal},
                                     {"material", &weights.material},
                                     {"light", &weights.light},
                                     {"pixel", &weights.pixel},
                                     {"perceptual", &weights.perceptual}}) {
    *weight = stage.number(name, *weight, 0, 1e6);
  }
  return weights;
}

std::vector<std::filesystem::path> take_folders(JsonFields& fields, const char* name,
                                                const std::filesystem::path& base) {
  std::vector<std::filesystem::path> result;
  for (const std::string& each : fields.texts(name)) result.push_back(base / each);
  return result;
}

SampledTraining take_sampled_training(JsonFields& fields, const std::filesystem::path& path) {
  const std::filesystem::path base = path.parent_path();
  SampledTraining result;
  result.loop = take_training_settings(fields);
  for (JsonFields& stage : take_stages(fields, path.string())) {
    result.loop.stages.push_back(take_stage(stage));
    result.task.stages.push_back(take_weights(stage));
    stage.refuse_others();
  }
  result.size = fields.whole("size", result.size, 128, 1024);
  if (result.size % 32 != 0) fields.refuse("size", "is no multiple of 32", "give one");
  result.samples.seed = result.loop.seed;
  result.samples.group = fields.whole("group", result.samples.group, 1, 1024);
  result.samples.map_size = fields.whole("map_size", result.samples.map_size, 8, 512);
  result.task.layer_light = fields.whole("layer_light", result.task.layer_light, 8, light_columns);
  if (light_columns % result.task.layer_light != 0)
    fields.refuse("layer_light", "does not divide 128", "take 16, 32, 64 or 128");
  result.task.layer_map = fields.whole("layer_map", result.task.layer_map, 8, 512);
  result.task.perceptual_side = fields.whole("perceptual_side", result.task.perceptual_side, 8, result.size);
  result.task.validation_batches = fields.whole("validation_batches", 8, 0, 100000);
  result.views = take_folders(fields, "views", base);
  result.validation_views =
      fields.has("validation_views") ? take_folders(fields, "validation_views", base) : result.views;
  result.materials = take_materials(fields, base);
  result.lights = take_lights(fields, base);
  if (fields.has("start")) result.start = base / fields.text("start");
  if (fields.has("output")) result.loop.output = base / fields.text("output");
  return result;
}

TrainingReport train_sampled(const SampledTraining& training, const SampledTaskMaker& make, const Rank& rank,
                             bool resume, const Progress& progress) {
  const StoredViews views(training.views, progress), validation_views(training.validation_views, progress);
  for (const StoredViews* each : {&views, &validation_views}) {
    if (each->side() != training.size) {
      throw InputError("views", fmt::format("are {} pixels wide, the network {}", each->side(), training.size),
                       "make the data set in that size, or change \"size\"");
    }
  }
  const EditSamples samples(views, training.materials, training.lights, training.samples);
  EditSamplesSettings plain = training.samples;
  plain.varied = false;
  plain.seed += 1;
  const EditSamples validation(validation_views, training.materials, training.lights, plain);
  torch::manual_seed(training.loop.seed);
  const std::unique_ptr<TrainingTask> task = make(samples, validation);
  return train(*task, training.loop, rank, resume, progress);
}

}  // namespace partwise
