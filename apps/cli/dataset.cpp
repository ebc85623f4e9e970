// partwise dataset: a configuration to shards of images with what is known of their pixels.

#include <fmt/format.h>

#include <memory>
#include <string>

#include "options.h"
#include "partwise/appearance/synthesis/dataset.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string config, output;
};

DatasetConfig read_config(const Options& options, const Run& run) {
  DatasetConfig config = read_dataset_config(options.config);
  if (!options.output.empty()) config.output = options.output;
  if (config.output.empty()) {
    throw InputError(options.config, "names no output folder", "give it \"output\", or the option -o");
  }
  if (run.seed != 0) config.seed = run.seed;
  return config;
}

void make(const Options& options, Run& run) {
  run.outputs.add_input("CONFIG", options.config);
  const DatasetConfig config = run.stage("read", [&] { return read_config(options, run); });
  const Rank rank = rank_from_environment();
  run.if_stopped = "finished shards stay, and running it again goes on from there";
  const DatasetReport result = run.stage("render", [&] { return make_dataset(config, rank, run.progress); });
  nlohmann::ordered_json& json = run.report;
  json["images"] = result.images;
  json["images_per_second"] = result.images / result.seconds;
  json["shards"] = result.shards;
  json["skipped"] = result.skipped;
  json["rank"] = rank.rank;
  json["ranks"] = rank.size;
  json["input"] = options.config;
  json["output"] = config.output.string();
  run.summary = fmt::format("{}: {} images in {} shards, {:.1f} a second; {} shards were there", options.config,
                            result.images, result.shards, result.images / result.seconds, result.skipped);
  if (rank.size > 1) run.summary += fmt::format("; rank {} of {}", rank.rank, rank.size);
  run.summary += "\nwrote into " + config.output.string();
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("CONFIG", options->config, "What is to be made (.json): shapes, materials, lights, how many images")
      ->required()
      ->type_name("");
  add_file(command, "-o", options->output, "The folder of the shards, in place of the configuration's")
      ->type_name("DIR");
  return [options](Run& run) { make(*options, run); };
}

}  // namespace

const Verb dataset_verb = {
    .name = "dataset",
    .summary = "Shards of training images: shapes whose parts wear random materials under random light",
    .details =
        "Makes what is missing of OUT/shard-000000.tar and so on (WebDataset): key.image.exr or .png, key.normal.png,\n"
        "key.mask.png, key.part.png, and key.json, which partwise render renders again. Under mpirun, srun, torchrun "
        "or\n"
        "Kubernetes each rank makes its share. Stopped at any moment, the same command goes on with the same bytes.\n"
        "docs/dataset.md says what a configuration holds.",
    .example =
        "  partwise dataset examples/dataset.json -o out/dataset\n"
        "  mpirun -n 4 partwise dataset examples/dataset.json -o out/dataset --quiet",
    .add = add,
};

}  // namespace partwise::cli
