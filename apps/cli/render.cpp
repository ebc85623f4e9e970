// partwise render: a scene file to images of what it looks like and of what is known of each pixel.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "options.h"
#include "partwise/appearance/rendering/channel_files.h"
#include "partwise/appearance/rendering/scene_file.h"
#include "partwise/base/atomic_file.h"
#include "partwise/imaging/exr.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string scene, folder, exr, png, normals, depth, mask, parts;
};

void write_normals(const std::filesystem::path& path, const GBuffer& seen) {
  if (lower_ending(path) != ".exr") return write_file(path, encode_normals(seen));
  const ExrLayer layer{seen.normal_image(), {"X", "Y", "Z"}};
  write_exr(path, {&layer, 1});
}

void write_depth(const std::filesystem::path& path, Image depth) {
  const ExrLayer layer{std::move(depth), {"Z"}};
  write_exr(path, {&layer, 1});
}

void render_file(const Options& options, Run& run) {
  run.outputs.add_input("SCENE", options.scene);
  const auto add = [&](const char* option, const std::string& file, const std::vector<std::string>& endings) {
    if (!file.empty()) run.outputs.add(option, file, endings);
  };
  add("--exr", options.exr, {".exr"});
  add("--png", options.png, {".png"});
  add("--normals", options.normals, {".png", ".exr"});
  add("--depth", options.depth, {".exr"});
  add("--mask", options.mask, {".png"});
  add("--parts", options.parts, {".png"});
  const SceneFile scene = run.stage("read", [&] {
    return options.folder.empty() ? read_scene(options.scene) : read_scene(options.scene, options.folder);
  });
  const auto start = std::chrono::steady_clock::now();
  const RenderedScene result = run.stage("render", [&] { return render(scene); });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  run.stage("write", [&] {
    const Image mask = result.seen.mask_image();
    if (!options.exr.empty()) write_exr(run.outputs.staged("--exr"), result.image);
    if (!options.png.empty()) write_file(run.outputs.staged("--png"), encode_tone_mapped(result.image, mask));
    if (!options.normals.empty()) write_normals(run.outputs.staged("--normals"), result.seen);
    if (!options.depth.empty()) write_depth(run.outputs.staged("--depth"), result.seen.depth_image());
    if (!options.mask.empty()) write_file(run.outputs.staged("--mask"), encode_mask(result.seen));
    if (!options.parts.empty()) write_file(run.outputs.staged("--parts"), encode_parts(result.seen));
  });
  nlohmann::ordered_json& json = run.report;
  json["images"] = 1;
  json["images_per_second"] = 1 / elapsed.count();
  json["width"] = scene.size.width;
  json["height"] = scene.size.height;
  json["foreground"] = result.seen.foreground();
  json["parts"] = scene.materials.size();
  json["input"] = options.scene;
  const std::string written = run.report_files({{"exr", options.exr},
                                                {"png", options.png},
                                                {"normals", options.normals},
                                                {"depth", options.depth},
                                                {"mask", options.mask},
                                                {"parts", options.parts}});
  run.summary =
      fmt::format("{}: {} x {} pixels, {:.1f} % of them covered, in {:.3f} s{}", options.scene, scene.size.width,
                  scene.size.height, 100 * result.seen.foreground(), elapsed.count(), written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("SCENE", options->scene, "The scene (.json): meshes, materials, light, camera")
      ->required()
      ->type_name("");
  add_file(command, "--folder", options->folder, "Where the files lie that the scene names [beside it]")
      ->type_name("DIR");
  add_file(command, "--exr", options->exr, "Write the image, linear light (.exr)");
  add_file(command, "--png", options->png, "Write the image for the eye: exposure by the median, gamma 2.2 (.png)");
  add_file(command, "--normals", options->normals,
           "Write normals in camera space: (n + 1) / 2 in 16 bits (.png), or as they are (.exr)");
  add_file(command, "--depth", options->depth, "Write depth along the view in model units, 0 where nothing is (.exr)");
  add_file(command, "--mask", options->mask, "Write the share of each pixel that is covered (.png)");
  add_file(command, "--parts", options->parts, "Write the part of each pixel, from 1, in 16 bits; 0 is none (.png)");
  return [options](Run& run) { render_file(*options, run); };
}

}  // namespace

const Verb render_verb = {
    .name = "render",
    .summary = "An image of meshes whose parts wear measured materials, under the light of a real place",
    .details =
        "Sums each pixel over all directions of an environment map, or looks it up in a reflectance map.\n"
        "docs/render.md says what a scene file holds.",
    .example =
        "  partwise render examples/scene.json --png chair.png --normals chair_normals.png\n"
        "  partwise render examples/scene.json --exr chair.exr --depth depth.exr --mask mask.png --json -",
    .add = add,
};

}  // namespace partwise::cli
