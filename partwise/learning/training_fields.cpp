#include "partwise/learning/training_fields.h"

#include <fmt/format.h>


namespace partwise {
namespace {

constexpr int most_steps = 2000000000;

}  // namespace

nlohmann::json read_training_file(const std::filesystem::path& path, std::uint64_t seed) {
  nlohmann::json whole = read_json(path);
  if (seed != 0 && whole.is_object()) whole["seed"] = seed;
  return whole;
}

TrainingSettings take_training_settings(JsonFields& fields) {
  TrainingSettings settings;
  const auto count = [&](const char* name, std::int64_t otherwise, int least) {
    return std::int64_t{fields.whole(name, static_cast<int>(otherwise), least, most_steps)};
  };
  settings.batch = count("batch", settings.batch, 1);
  settings.largest_gradient = fields.number("largest_gradient", settings.largest_gradient, 1e-6, 1e9);
  settings.report_every = count("report_every", settings.report_every, 1);
  settings.checkpoint_every = count("checkpoint_every", settings.checkpoint_every, 1);
  settings.validate_every = count("validate_every", settings.validate_every, 1);
  settings.patience = fields.whole("patience", settings.patience, 0, most_steps);
  settings.seed = static_cast<std::uint64_t>(count("seed", 0, 0));
  return settings;
}

std::vector<JsonFields> take_stages(JsonFields& fields, const std::string& file) {
  const nlohmann::json& stages = fields.need("stages");
  if (!stages.is_array() || stages.empty())
    fields.refuse("stages", "is no list of stages", "write [{\"steps\": 1000}]");
  std::vector<JsonFields> result;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    result.emplace_back(file, fmt::format("stages[{}]", i), stages[i], training_page);
  }
  return result;
}

TrainingStage take_stage(JsonFields& fields) {
  TrainingStage stage;
  fields.need("steps");
  stage.steps = fields.whole("steps", 0, 1, most_steps);
  stage.learning_rate = fields.number("learning_rate", stage.learning_rate, 1e-12, 1);
  stage.final_learning_rate = fields.number("final_learning_rate", stage.learning_rate, 1e-12, 1);
  stage.beta1 = fields.number("beta1", stage.beta1, 0, 0.999);
  return stage;
}

}  // namespace partwise
