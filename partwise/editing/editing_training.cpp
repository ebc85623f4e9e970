#include "partwise/editing/editing_training.h"

#include <fmt/format.h>
#include <torch/utils.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/editing/editing_task.h"
#include "partwise/editing/encoder_decoder.h"
#include "partwise/learning/training_fields.h"

namespace partwise {
namespace {

std::vector<std::filesystem::path> folders(JsonFields& fields, const char* name, const std::filesystem::path& base) {
  std::vector<std::filesystem::path> result;
  for (const std::string& each : fields.texts(name)) result.push_back(base / each);
  return result;
}

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

void take_given(JsonFields& fields, EditingTaskSettings& task) {
  if (!fields.has("given")) return;
  for (const std::string& each : fields.texts("given")) {
    if (each == "normals")
      task.given_normals = true;
    else if (each == "light")
      task.given_light = true;
    else
      fields.refuse("given", fmt::format("\"{}\" cannot be given", each), "write normals, light, or both");
  }
}

EditingWeights take_weights(JsonFields& fields) {
  EditingWeights weights;
  for (const auto& [name, weight] : {std::pair{"normal", &weights.normal},
                                     {"material", &weights.material},
                                     {"light", &weights.light},
                                     {"pixel", &weights.pixel},
                                     {"perceptual", &weights.perceptual}}) {
    *weight = fields.number(name, *weight, 0, 1e6);
  }
  return weights;
}

}  // namespace

EditingTraining read_editing_training(const std::filesystem::path& path, std::uint64_t seed) {
  const std::filesystem::path base = path.parent_path();
  nlohmann::json whole = nlohmann::json::parse(read_bytes(path), nullptr, false);
  if (whole.is_discarded()) throw InputError(path.string(), "is not JSON", "check brackets, quotes and commas");
  if (seed != 0 && whole.is_object()) whole["seed"] = seed;
  JsonFields fields(path.string(), "", whole, "docs/training.md");
  EditingTraining result;
  fields.need("network");
  result.kind = fields.choice<EditingKind>(
      "network", result.kind, {{"editing", EditingKind::layers}, {"encoder_decoder", EditingKind::encoder_decoder}});
  result.loop = take_training_settings(fields);
  for (JsonFields& stage : take_stages(fields, path.string())) {
    result.loop.stages.push_back(take_stage(stage));
    result.task.stages.push_back(take_weights(stage));
    stage.refuse_others();
  }
  result.networks.size = fields.whole("size", result.networks.size, 128, 1024);
  result.networks.normal_channels = fields.whole("normal_channels", result.networks.normal_channels, 32, 512);
  if (result.networks.size % 32 != 0 || result.networks.normal_channels % 16 != 0)
    fields.refuse("size", "or normal_channels does not fit", "give a multiple of 32, and one of 16");
  result.networks.dropout = fields.number("dropout", result.networks.dropout, 0, 0.9);
  result.samples.seed = result.loop.seed;
  result.samples.group = fields.whole("group", result.samples.group, 1, 1024);
  result.samples.map_size = fields.whole("map_size", result.samples.map_size, 8, 512);
  take_given(fields, result.task);
  result.task.layer_light = fields.whole("layer_light", result.task.layer_light, 8, light_columns);
  if (light_columns % result.task.layer_light != 0)
    fields.refuse("layer_light", "does not divide 128", "take 16, 32, 64 or 128");
  result.task.layer_map = fields.whole("layer_map", result.task.layer_map, 8, 512);
  result.task.perceptual_side = fields.whole("perceptual_side", result.task.perceptual_side, 8, result.networks.size);
  result.task.validation_batches = fields.whole("validation_batches", 8, 0, 100000);
  result.views = folders(fields, "views", base);
  result.validation_views = fields.has("validation_views") ? folders(fields, "validation_views", base) : result.views;
  result.materials = take_materials(fields, base);
  result.lights = take_lights(fields, base);
  if (fields.has("start")) result.start = base / fields.text("start");
  if (fields.has("output")) result.loop.output = base / fields.text("output");
  fields.refuse_others();
  result.loop.configuration = whole.dump(2) + "\n";
  return result;
}

TrainingReport train_editing(const EditingTraining& training, const Rank& rank, bool resume, const Progress& progress) {
  const StoredViews views(training.views, progress), validation_views(training.validation_views, progress);
  for (const StoredViews* each : {&views, &validation_views}) {
    if (each->side() != training.networks.size) {
      throw InputError("views", fmt::format("are {} pixels wide, the network {}", each->side(), training.networks.size),
                       "make the data set in that size, or change \"size\"");
    }
  }
  const EditSamples samples(views, training.materials, training.lights, training.samples);
  EditSamplesSettings plain = training.samples;
  plain.varied = false;
  plain.seed += 1;
  const EditSamples validation(validation_views, training.materials, training.lights, plain);
  torch::manual_seed(training.loop.seed);
  const MaterialRange range = MaterialRange::of(training.materials);
  std::unique_ptr<TrainingTask> task;
  if (training.kind == EditingKind::encoder_decoder) {
    const EncoderDecoder network(training.networks.size, range);
    task = std::make_unique<EncoderDecoderTask>(network, samples, validation, training.task);
  } else {
    const EditingNetworks networks(training.networks, range);
    task = std::make_unique<EditingTask>(networks, samples, validation, training.task);
  }
  if (!training.start.empty()) read_weights(training.start, task->network());
  return train(*task, training.loop, rank, resume, progress);
}

}  // namespace partwise
