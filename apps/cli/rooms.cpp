// partwise rooms: a configuration to pictures of furnished rooms, with the depth that a sensor would see.

#include <fmt/format.h>

#include <memory>
#include <string>

#include "options.h"
#include "partwise/normals/scenes/room_dataset.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string config, output;
};

RoomDatasetConfig read_config(const Options& options, const Run& run) {
  RoomDatasetConfig config = read_room_dataset_config(options.config, run.seed);
  if (!options.output.empty()) config.output = options.output;
  if (config.output.empty())
    throw InputError(options.config, "names no output folder", "give it \"output\", or the option -o");
  return config;
}

void make(const Options& options, Run& run) {
  run.outputs.add_input("CONFIG", options.config);
  const RoomDatasetConfig config = run.stage("read", [&] { return read_config(options, run); });
  run.if_stopped = "finished frames stay, and running it again goes on from there";
  const RoomDatasetReport result = run.stage("render", [&] { return make_room_dataset(config, run.progress); });
  nlohmann::ordered_json& json = run.report;
  json["images"] = result.made;
  json["images_per_second"] = result.made > 0 ? result.made / result.seconds : 0;
  json["kept"] = result.kept;
  json["input"] = options.config;
  json["output"] = config.output.string();
  run.summary = fmt::format("{}: {} rooms, {:.1f} a second; {} were there\nwrote into {}", options.config, result.made,
                            json["images_per_second"].get<double>(), result.kept, config.output.string());
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("CONFIG", options->config,
                  "What is to be made (.json): furniture, materials, lights, how many images")
      ->required()
      ->type_name("");
  add_file(command, "-o", options->output, "The folder of the rooms, in place of the configuration's")
      ->type_name("DIR");
  return [options](Run& run) { make(*options, run); };
}

}  // namespace

const Verb rooms_verb = {
    .name = "rooms",
    .summary = "Pictures of furnished rooms with exact normals and with what a depth sensor would see",
    .details =
        "Makes OUT/color and OUT/depth, laid out as RGB-D data is, and what only a rendered room knows: OUT/normals,\n"
        "OUT/materials and OUT/truth. Stopped at any moment, the same command goes on with the same bytes.\n"
        "docs/rooms.md says what a configuration holds.",
    .example = "  partwise rooms examples/rooms.json -o out/rooms",
    .add = add,
};

}  // namespace partwise::cli
