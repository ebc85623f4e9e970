#include "partwise/normals/prediction/normal_training.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "partwise/base/error.h"
#include "partwise/learning/training_fields.h"
#include "partwise/normals/prediction/normal_task.h"

namespace partwise {
namespace {

NormalPredictorSettings take_network(JsonFields& fields, int size) {
  NormalPredictorSettings network;
  network.size = size;
  fields.need("architecture");
  network.architecture = fields.choice<NormalArchitecture>(
      "architecture", network.architecture,
      {{"multi_branch", NormalArchitecture::multi_branch}, {"u", NormalArchitecture::u}});
  const bool u = network.architecture == NormalArchitecture::u;
  network.channels = u ? UNetworkSettings().channels : NormalNetworkSettings().channels;
  network.channels = fields.whole("channels", network.channels, u ? 16 : 32, 512);
  if (network.channels % 16 != 0) fields.refuse("channels", "is no multiple of 16", "give one");
  if (!u) network.dropout = fields.number("dropout", network.dropout, 0, 0.9);
  return network;
}

}  // namespace

NormalTraining read_normal_training(const std::filesystem::path& path, std::uint64_t seed) {
  const nlohmann::json whole = read_training_file(path, seed);
  JsonFields fields(path.string(), "", whole, training_page);
  fields.need("network");
  NormalTraining result{take_sampled_training(fields, path), {}, {}};
  result.network = take_network(fields, result.size);
  result.samples.parts = fields.number("parts", 0, 0, 1);
  if (fields.has("readers")) result.readers = path.parent_path() / fields.text("readers");
  fields.refuse_others();
  result.loop.configuration = whole.dump(2) + "\n";
  return result;
}

TrainingReport train_normals(const NormalTraining& training, const Rank& rank, bool resume, const Progress& progress) {
  const auto make = [&](const EditSamples& samples, const EditSamples& validation) {
    const NormalPredictor predictor(training.network);
    if (!training.start.empty()) read_normal_weights(training.start, predictor);
    std::optional<EditingNetworks> readers;
    if (!training.readers.empty()) {
      readers = read_editing_networks(training.readers);
      if (readers->settings().size != training.size)
        throw InputError(
            training.readers.string(),
            fmt::format("reads pictures of {} pixels, the training has {}", readers->settings().size, training.size),
            "give networks of that size");
    }
    return std::make_unique<NormalTask>(predictor, readers, samples, validation, training.task);
  };
  return train_sampled(training, make, rank, resume, progress);
}

}  // namespace partwise
