#include "partwise/appearance/rendering/scene_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/appearance/shapes/shape_fields.h"
#include "partwise/base/error.h"
#include "partwise/base/json_fields.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

using nlohmann::json;

class SceneReader {
 public:
  SceneReader(std::filesystem::path path, std::filesystem::path folder)
      : path_(std::move(path)), folder_(std::move(folder)) {}

  SceneFile read() {
    const json whole = read_json(path_);
    JsonFields fields = object("", whole);
    const json& meshes = fields.need("meshes");
    if (!meshes.is_array() || meshes.empty()) fields.refuse("meshes", "is no list of meshes", "write [{ ... }]");
    for (std::size_t i = 0; i < meshes.size(); ++i) add_mesh(fmt::format("meshes[{}]", i), meshes[i]);
    read_light("light", fields.need("light"));
    if (const json* camera = fields.find("camera")) read_camera("camera", *camera);
    std::tie(scene_.size.width, scene_.size.height) = fields.two_sizes("size", {scene_.size.width, scene_.size.height});
    scene_.size.samples = fields.whole("samples", 4, 1, 256);
    scene_.shadows = fields.truth("shadows", false);
    scene_.path =
        fields.choice<RenderPath>("path", scene_.shadows ? RenderPath::exact : RenderPath::reflectance_map,
                                  {{"exact", RenderPath::exact}, {"reflectance_map", RenderPath::reflectance_map}});
    scene_.map_size = fields.whole("map_size", 64, 8, 2048);
    if (scene_.shadows && scene_.path != RenderPath::exact) {
      fields.refuse("shadows", "needs the exact path", "leave path out, or shadows");
    }
    fields.find("about");  // what people and programs note there
    fields.refuse_others();
    return std::move(scene_);
  }

 private:
  JsonFields object(const std::string& place, const json& value) const {
    return {path_.string(), place, value, "docs/render.md"};
  }

  std::filesystem::path file(const std::string& name) {
    scene_.files.push_back(folder_ / name);
    return scene_.files.back();
  }

  void add_mesh(const std::string& place, const json& value) {
    JsonFields fields = object(place, value);
    RenderMesh mesh = read_shape_or_mesh(fields);
    mesh.crease_degrees = fields.number("crease", mesh.crease_degrees, 0, 180);
    const auto [least, most] = std::ranges::minmax(mesh.parts);
    constexpr int most_parts = 65534;  // that a picture of 16 bits can tell apart
    const auto before = static_cast<int>(scene_.materials.size());
    if (least < 0 || most >= most_parts - before) {
      fields.refuse("labels", fmt::format("holds {}", least < 0 ? least : most), "number parts from 0");
    }
    add_materials(fields, most + 1);
    for (int& part : mesh.parts) part += before;
    scene_.meshes.push_back(std::move(mesh));
    fields.refuse_others();
  }

  RenderMesh read_shape_or_mesh(JsonFields& fields) {
    RenderMesh mesh;
    const std::filesystem::path path = file(fields.text("file"));
    const bool by_rule = fields.has("parts"), by_component = fields.truth("components", false);
    const bool groups_labels = by_rule && fields.text("parts") == "labels";
    const bool by_labels = fields.has("labels") && !groups_labels;
    const bool is_shape = by_rule || is_archive(path);
    if (by_component + by_labels + by_rule > 1) {
      const std::string first = by_component ? "components" : "labels";
      fields.refuse(first, by_labels && by_component ? "and labels are both there" : "and parts are both there",
                    "keep one");
    }
    if (is_shape) {
      ShapeFile shape{path, is_archive(path) ? fields.text("model") : ""};
      if (groups_labels) shape.labels = file(fields.text("labels"));
      mesh.mesh = read_shape(shape);
      const PartSettings settings = take_part_settings(fields, PartRule::whole);
      if (!by_component && !by_labels) mesh.parts = worn_parts(shape, mesh.mesh, settings);
    } else {
      mesh.mesh = read_mesh(path);
    }
    if (by_component) mesh.parts = face_components_by_vertex(mesh.mesh).label;
    if (by_labels) {
      mesh.parts = read_labels(file(fields.text("labels")));
      if (static_cast<Eigen::Index>(mesh.parts.size()) != mesh.mesh.faces.rows()) {
        fields.refuse("labels", fmt::format("has {} lines for {} faces", mesh.parts.size(), mesh.mesh.faces.rows()),
                      "give the labels of this mesh");
      }
    }
    if (mesh.parts.empty()) mesh.parts.assign(static_cast<std::size_t>(mesh.mesh.faces.rows()), 0);
    return mesh;
  }

  // One material for all parts, or a list that the parts take in turn.
  void add_materials(JsonFields& fields, int parts) {
    const json& given = fields.need("material");
    std::vector<std::shared_ptr<const Brdf>> materials;
    if (given.is_array()) {
      for (std::size_t i = 0; i < given.size(); ++i) {
        materials.push_back(material(fields, fmt::format("material[{}]", i), given[i]));
      }
    } else {
      materials.push_back(material(fields, "material", given));
    }
    if (materials.empty()) fields.refuse("material", "is an empty list", "name a material");
    for (int part = 0; part < parts; ++part) {
      scene_.materials.push_back(materials[static_cast<std::size_t>(part) % materials.size()]);
    }
  }

  std::shared_ptr<const Brdf> material(const JsonFields& fields, const std::string& name, const json& value) {
    if (value.is_string() && !value.get<std::string>().empty()) {
      const std::string text = value.get<std::string>();
      if (is_material_file(text)) file(text);
      return find_material(text, folder_);
    }
    if (!value.is_object()) {
      fields.refuse(name, "is neither a name nor an object",
                    "name a shipped material, a file, or give {\"albedo\": ...}");
    }
    JsonFields own = object(fields.place_of(name), value);
    const json& albedo = own.need("albedo");
    const bool is_colour = albedo.is_array() && albedo.size() == 3 && std::ranges::all_of(albedo, [](const json& each) {
                             return each.is_number() && each.get<double>() >= 0 && each.get<double>() <= 1;
                           });
    if (!is_colour) own.refuse("albedo", "is not three numbers from 0 to 1", "write [red, green, blue]");
    own.refuse_others();
    const Eigen::Vector3d colour(albedo[0].get<double>(), albedo[1].get<double>(), albedo[2].get<double>());
    return std::make_shared<MicrofacetBrdf>(colour);  // without lobes, that is Lambert's
  }

  void read_light(const std::string& place, const json& value) {
    JsonFields fields = object(place, value);
    if (fields.has("name") == fields.has("file")) {
      fields.refuse("name", "and file: one of them has to be there", "name a shipped light, or a file");
    }
    const EnvironmentLight light =
        fields.has("name") ? shipped_light(fields.text("name")) : partwise::read_light(file(fields.text("file")));
    const int height = fields.whole("height", 64, 1, 4096);
    const int width = fields.whole("width", 2 * height, 1, 8192);
    const double rotation = fields.number("rotation", 0, -36000, 36000);
    const double exposure = fields.number("scale", 1, 0, 1e6);
    scene_.light_turns_with_camera = fields.choice<bool>("turns_with", true, {{"camera", true}, {"scene", false}});
    fields.refuse_others();
    Image map = light.resized(width, height).rotated(rotation).radiance();
    for (float& each : map.values) each *= static_cast<float>(exposure);
    scene_.light = EnvironmentLight(std::move(map), path_.string());
  }

  void read_camera(const std::string& place, const json& value) {
    JsonFields fields = object(place, value);
    ShareView& view = scene_.view;
    view.azimuth = fields.number("azimuth", view.azimuth, -36000, 36000);
    view.elevation = fields.number("elevation", view.elevation, -90, 90);
    const bool orthographic = fields.choice<bool>("projection", true, {{"orthographic", true}, {"perspective", false}});
    view.field_of_view = fields.number("field_of_view", 30, 1, 120);
    if (orthographic && fields.has("field_of_view")) {
      fields.refuse("field_of_view", "means nothing to an orthographic camera", "leave it out, or take perspective");
    }
    if (orthographic) view.field_of_view = 0;
    view.share = fields.number("share", view.share, 0.01, 0.9);
    fields.refuse_others();
  }

  std::filesystem::path path_, folder_;
  SceneFile scene_;
};

}  // namespace

SceneFile read_scene(const std::filesystem::path& path) { return read_scene(path, path.parent_path()); }

SceneFile read_scene(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return SceneReader(path, folder).read();
}

RenderedScene render(const SceneFile& scene) {
  const RenderScene meshes(scene.meshes);
  const Camera camera = frame_share(meshes, scene.view, static_cast<double>(scene.size.width) / scene.size.height);
  GBuffer seen = meshes.view(camera, scene.size);
  const PartColours colours(
      scene.materials,
      light_samples(scene.light,
                    scene.light_turns_with_camera ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : camera.axes),
      scene.path, scene.map_size);
  Image image = scene.shadows ? colours.shadowed_image(seen, meshes, camera) : colours.image(seen);
  return {std::move(seen), camera, std::move(image)};
}

}  // namespace partwise
