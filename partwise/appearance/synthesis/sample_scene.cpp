#include "partwise/appearance/synthesis/sample_scene.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/shapes/shape_fields.h"

namespace partwise {

double light_rotation(const Sample& sample) { return sample.light_turn * 180 / std::numbers::pi; }

ShareView sample_view(const DatasetConfig& config, int viewpoint) {
  ShareView view = config.view;
  view.azimuth = 360.0 * viewpoint / config.viewpoints;
  return view;
}

std::string sample_scene(const DatasetConfig& config, std::uint64_t number, const Sample& sample) {
  using Json = nlohmann::ordered_json;
  const ShapeFile& shape = config.shapes[static_cast<std::size_t>(sample.shape)];
  const std::string& light = config.lights[static_cast<std::size_t>(sample.light)];
  const ShareView view = sample_view(config, sample.viewpoint);
  Json mesh = {{"file", shape.file.string()}};
  if (!shape.model.empty()) mesh["model"] = shape.model;
  mesh["parts"] = word_of(config.parts.rule);
  if (!shape.labels.empty()) mesh["labels"] = shape.labels.string();
  mesh["groups"] = config.parts.groups;
  if (config.parts.rule == PartRule::corise) mesh["tolerance"] = config.parts.tolerance;
  mesh["crease"] = config.crease_degrees;
  mesh["material"] = Json::array();
  for (const int each : sample.materials) mesh["material"].push_back(config.materials[static_cast<std::size_t>(each)]);
  const Json scene = {
      {"meshes", Json::array({mesh})},
      {"light",
       {{is_light_file(light) ? "file" : "name", light},
        {"width", config.light_width},
        {"height", config.light_height},
        {"rotation", light_rotation(sample)},
        {"turns_with", "camera"}}},
      {"camera",
       {{"projection", "orthographic"},
        {"azimuth", view.azimuth},
        {"elevation", view.elevation},
        {"share", view.share}}},
      {"size", {config.size.width, config.size.height}},
      {"samples", config.size.samples},
      {"path", config.path == RenderPath::exact ? "exact" : "reflectance_map"},
      {"map_size", config.map_size},
      {"about",
       {{"number", number},
        {"combination", number / static_cast<std::uint64_t>(config.views)},
        {"viewpoint", sample.viewpoint},
        {"parts", sample.materials.size()},
        {"seed", config.seed}}},
  };
  return scene.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace partwise
