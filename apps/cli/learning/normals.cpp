// partwise normals: a photo of an object to the normals of its surface.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "learning_verbs.h"
#include "options.h"
#include "partwise/base/shared_files.h"
#include "partwise/normals/prediction/photo_normals.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/normal_files.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

enum class Model { single, scene };
const Choices<Model> models = {{"single", Model::single}, {"scene", Model::scene}};
const Choices<NormalBits> depths = {{"8", NormalBits::eight}, {"16", NormalBits::sixteen}};

struct Options {
  std::string photo, mask, output, weights;
  Model model = Model::single;
  NormalBits bits = NormalBits::sixteen;
};

std::filesystem::path weights_file(const Options& options) {
  if (!options.weights.empty()) return options.weights;
  return shared_file(options.model == Model::scene ? "models/networks/scenes.pt" : "models/networks/objects.pt");
}

Image object_normals(const Options& options, const NormalPredictor& predictor, Run& run) {
  const Photo photo = run.stage("read", [&] {
    return read_photo(options.photo, options.mask.empty() ? std::vector<std::filesystem::path>{}
                                                          : std::vector<std::filesystem::path>{options.mask});
  });
  return run.stage("look", [&] { return photo_normals(predictor, photo); });
}

Image whole_normals(const Options& options, const NormalPredictor& predictor, Run& run) {
  const Image shown = run.stage("read", [&] { return read_shown(options.photo); });
  return run.stage("look", [&] { return scene_normals(predictor, shown); });
}

void find_normals(const Options& options, Run& run) {
  if (!options.mask.empty() && options.model == Model::scene)
    throw UsageError("--mask is of one object, and --model scene looks at the whole; leave one of them out");
  run.outputs.add_input("PHOTO", options.photo);
  if (!options.mask.empty()) run.outputs.add_input("--mask", options.mask);
  run.outputs.add("-o", options.output, {".png", ".exr"});
  const NormalPredictor predictor = run.stage("weights", [&] {
    return options.model == Model::scene ? read_scene_predictor(weights_file(options))
                                         : read_normal_predictor(weights_file(options));
  });
  const Image normals =
      options.model == Model::scene ? whole_normals(options, predictor, run) : object_normals(options, predictor, run);
  run.stage("write", [&] { write_normals(run.outputs.staged("-o"), normals, options.bits); });
  std::size_t pixels = 0;
  for (const float known : known_normals(normals).values) pixels += known > 0 ? 1 : 0;
  run.report["model"] = name_of(models, options.model);
  run.report["width"] = normals.width;
  run.report["height"] = normals.height;
  run.report["pixels"] = pixels;
  run.report["input"] = options.photo;
  const std::string written = run.report_files({{"output", options.output}});
  run.summary = fmt::format("{}: normals of {} pixels{}", options.photo, pixels, written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("PHOTO", options->photo, "A picture of an object or a room (.png, .jpg)")
      ->required()
      ->type_name("");
  add_file(command, "--mask", options->mask,
           "White where the object is, of the photo's size (.png). Left out: what is not transparent, or not of the "
           "background's plain colour");
  add_choice(command, "--model", options->model, models,
             "single: one object; scene: all that is seen, of a room [single]");
  add_choice(command, "--bits", options->bits, depths, "Of a .png, a channel [16]");
  add_file(command, "--weights", options->weights, "A network that partwise train made [that which ships]");
  add_file(command, "-o", options->output, "The normals (.png, .exr)")->required();
  return [options](Run& run) { find_normals(*options, run); };
}

}  // namespace

const Verb normals_verb = {
    .name = normals_line.name,
    .summary = normals_line.summary,
    .details =
        "Red is to the right, green up, blue to the camera: (n + 1) / 2 in a .png, n itself in an .exr.\n"
        "What is not object is the zero vector, middle grey in a .png.",
    .example =
        "  partwise normals car.png -o normals.png\n"
        "  partwise normals chair.jpg --mask chair.mask.png -o normals.exr\n"
        "  partwise normals room.jpg --model scene -o normals.png",
    .add = add,
};

}  // namespace partwise::cli
