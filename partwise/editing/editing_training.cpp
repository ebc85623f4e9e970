#include "partwise/editing/editing_training.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "partwise/base/error.h"
#include "partwise/editing/editing_task.h"
#include "partwise/editing/encoder_decoder.h"
#include "partwise/learning/training_fields.h"

namespace partwise {
namespace {

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

}  // namespace

EditingTraining read_editing_training(const std::filesystem::path& path, std::uint64_t seed) {
  const nlohmann::json whole = read_training_file(path, seed);
  JsonFields fields(path.string(), "", whole, training_page);
  fields.need("network");
  EditingTraining result{take_sampled_training(fields, path), EditingKind::layers, {}};
  result.kind = fields.choice<EditingKind>(
      "network", result.kind, {{"editing", EditingKind::layers}, {"encoder_decoder", EditingKind::encoder_decoder}});
  result.networks.size = result.size;
  result.networks.normal_channels = fields.whole("normal_channels", result.networks.normal_channels, 32, 512);
  if (result.networks.normal_channels % 16 != 0) fields.refuse("normal_channels", "is no multiple of 16", "give one");
  result.networks.dropout = fields.number("dropout", result.networks.dropout, 0, 0.9);
  take_given(fields, result.task);
  fields.refuse_others();
  result.loop.configuration = whole.dump(2) + "\n";
  return result;
}

TrainingReport train_editing(const EditingTraining& training, const Rank& rank, bool resume, const Progress& progress) {
  const auto make = [&](const EditSamples& samples, const EditSamples& validation) {
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
    return task;
  };
  return train_sampled(training, make, rank, resume, progress);
}

}  // namespace partwise
