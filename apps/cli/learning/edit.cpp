// partwise edit: one photo of an object to the same object in another material.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "learning_verbs.h"
#include "options.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/shared_files.h"
#include "partwise/editing/edit_photo.h"
#include "partwise/editing/layer_files.h"
#include "partwise/imaging/png.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string photo, output, other, light, layers, weights;
  std::vector<std::string> materials, masks, other_masks;
  bool refine = false;
};

std::filesystem::path weights_file(const Options& options) {
  return options.weights.empty() ? shared_file("models/networks/editing.pt") : std::filesystem::path(options.weights);
}

DsbrdfCoefficients fitted_material(const std::string& name) {
  const auto material = std::dynamic_pointer_cast<const Dsbrdf>(find_material(name));
  if (material == nullptr) throw InputError(name, "is measured, not fitted", "fit it with partwise material fit");
  return material->coefficients();
}

PhotoLayers layers_of(const Options& options, const EditingNetworks& networks, const Photo& photo, Run& run) {
  ReadingSettings settings;
  settings.refine = options.refine;
  return read_layers(networks, photo, settings, run.progress);
}

// One for each region; a single one is for all.
std::vector<DsbrdfCoefficients> wanted_materials(const Options& options, const EditingNetworks& networks,
                                                 std::size_t regions, Run& run) {
  std::vector<DsbrdfCoefficients> materials;
  if (options.other.empty()) {
    for (const std::string& name : options.materials) materials.push_back(fitted_material(name));
  } else {
    const Photo other = read_photo(options.other, {options.other_masks.begin(), options.other_masks.end()});
    const PhotoLayers layers = layers_of(options, networks, other, run);
    const at::Tensor rows = networks.range().coefficients(layers.found.material);
    for (std::int64_t i = 0; i < rows.size(0); ++i) materials.push_back(as_material(rows[i]));
  }
  if (materials.size() == 1) materials.resize(regions, materials.front());
  if (materials.size() != regions) {
    throw InputError(options.photo, fmt::format("has {} regions for {} materials", regions, materials.size()),
                     "give one material for all, or one for each --mask, in their order");
  }
  return materials;
}

std::optional<EnvironmentLight> other_light(const Options& options) {
  if (options.light.empty()) return std::nullopt;
  return exposed_for_grey_card(named_light(options.light));
}

void edit(const Options& options, Run& run) {
  run.outputs.add_input("PHOTO", options.photo);
  for (const std::string& mask : options.masks) run.outputs.add_input("--mask", mask);
  for (const std::string& mask : options.other_masks) run.outputs.add_input("--from-mask", mask);
  if (!options.other.empty()) run.outputs.add_input("--from", options.other);
  run.outputs.add("-o", options.output, {".png"});
  const EditingNetworks networks = run.stage("weights", [&] { return read_editing_networks(weights_file(options)); });
  const Photo photo = run.stage("read", [&] {
    return read_photo(options.photo, {options.masks.begin(), options.masks.end()});
  });
  const std::optional<EnvironmentLight> light = other_light(options);
  const std::vector<DsbrdfCoefficients> materials =
      run.stage("material", [&] { return wanted_materials(options, networks, photo.regions.size(), run); });
  const PhotoLayers layers = run.stage("look", [&] { return layers_of(options, networks, photo, run); });
  const Image result = run.stage("render", [&] { return edited(photo, layers, materials, light); });
  run.stage("write", [&] {
    write_file(run.outputs.staged("-o"), encode_png(result, PngCodes::plain8));
    if (!options.layers.empty()) write_layers(options.layers, layers, networks.range());
  });
  run.report["l2_reconstruction"] = layers.error;
  if (options.refine) run.report["l2_before_refinement"] = layers.error_before;
  run.report["regions"] = photo.regions.size();
  run.report["input"] = options.photo;
  const std::string written = run.report_files({{"output", options.output}, {"layers", options.layers}});
  run.summary = fmt::format(
      "{}: rendered anew from what was found in it, it differs from the photo by {:.1f} (mean squared, 0 to 255){}",
      options.photo, layers.error, written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("PHOTO", options->photo, "A picture of an object (.png, .jpg)")->required()->type_name("");
  CLI::Option* material = command
                              .add_option("--material", options->materials,
                                          "A shipped material (partwise material list) or a fitted one "
                                          "(.json); several: one for each --mask, in their order")
                              ->type_name("NAME")
                              ->allow_extra_args(false);
  CLI::Option* from = add_file(command, "--from", options->other, "Take the material from this picture instead");
  material->excludes(from);
  command
      .add_option("--mask", options->masks,
                  "White where the object is, of the photo's size (.png); several: regions "
                  "of their own. Left out: what is not transparent, or not of the "
                  "background's plain colour")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command.add_option("--from-mask", options->other_masks, "The same of the picture of --from")
      ->needs(from)
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_file(command, "--light", options->light, "Light it anew: a shipped light's name, .exr or .hdr");
  command.add_flag("--refine", options->refine, "Make what was found explain the photo better first: slower, nearer");
  add_file(command, "--layers", options->layers, "Write into this folder what was found: normals, light, materials")
      ->type_name("DIR");
  add_file(command, "--weights", options->weights, "Networks that partwise train made [those that ship]");
  add_file(command, "-o", options->output, "The edited picture (.png)")->required();
  return [options](Run& run) {
    if (options->materials.empty() && options->other.empty())
      throw UsageError("say which material: --material NAME, or --from another picture");
    edit(*options, run);
  };
}

}  // namespace

const Verb edit_verb = {
    .name = edit_line.name,
    .summary = edit_line.summary,
    .details =
        "Finds the object's normals, material and the light on it with networks, and renders it again in the new "
        "material.\n"
        "The rest of the photo stays as it is. Several regions: a --mask and a --material for each.",
    .example =
        "  partwise edit car.png --material gold-metallic-paint -o gold.png\n"
        "  partwise edit chair.png --mask seat.png --material red-fabric --mask legs.png --material chrome -o "
        "chair2.png",
    .add = add,
};

}  // namespace partwise::cli
