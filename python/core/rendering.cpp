// partwise.render and partwise.render_scene: images of meshes in materials under a light.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "lights.h"
#include "long_call.h"
#include "materials.h"
#include "mesh_arguments.h"
#include "partwise/appearance/rendering/scene_file.h"

namespace partwise::python {
namespace {

struct Rendering {
  py::array image, normals, depth, mask, parts;
  Camera camera;
};

Rendering as_rendering(RenderedScene rendered) {
  const GBuffer& seen = rendered.seen;
  return {.image = image_out(std::move(rendered.image)),
          .normals = image_out(seen.normal_image()),
          .depth = image_out(seen.depth_image()),
          .mask = image_out(seen.mask_image()),
          .parts = array_out(seen.part_of_pixels(), {seen.size.height, seen.size.width}),
          .camera = rendered.camera};
}

void require(bool holds, const char* setting, const char* problem, const char* remedy) {
  if (!holds) throw InputError(setting, problem, remedy);
}

// As scene files have it: the light reduced to 64 x 128 and turned, its centre behind the object in every view.
EnvironmentLight placed_light(const py::object& given, double rotation) {
  constexpr int height = 64;
  const EnvironmentLight light = light_in(given);
  const py::gil_scoped_release released;
  return light.resized(2 * height, height).rotated(rotation);
}

// One for all parts, or a list that the parts take in turn.
std::vector<std::shared_ptr<const Brdf>> materials_in(const py::object& given, int parts) {
  std::vector<std::shared_ptr<const Brdf>> different, worn;
  if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) {
    for (const py::handle& each : given) {
      different.push_back(material_in(each, fmt::format("material[{}]", different.size())).brdf);
    }
  } else {
    different.push_back(material_in(given, "material").brdf);
  }
  require(!different.empty(), "material", "is an empty list", "name a material");
  for (int part = 0; part < parts; ++part) worn.push_back(different[static_cast<std::size_t>(part) % different.size()]);
  return worn;
}

std::vector<int> parts_in(const py::object& labels, const Mesh& mesh) {
  if (labels.is_none()) return std::vector<int>(static_cast<std::size_t>(mesh.faces.rows()), 0);
  std::vector<int> parts = labels_in(labels, "labels");
  if (static_cast<Eigen::Index>(parts.size()) != mesh.faces.rows()) {
    throw InputError("labels", fmt::format("has {} labels for {} faces", parts.size(), mesh.faces.rows()),
                     "give the labels of this mesh");
  }
  return parts;
}

Rendering render_mesh(const py::object& given, const py::object& material, const py::object& labels,
                      const py::object& light, double rotation, double azimuth, double elevation, double field_of_view,
                      double share, std::pair<int, int> size, int samples, bool exact, bool shadows, double crease) {
  const SharedMesh mesh = mesh_in(given);
  require(mesh->faces.rows() > 0, "mesh", "has no faces", "give at least one");
  RenderMesh worn{*mesh, parts_in(labels, *mesh), crease};
  const auto [least, most] = std::ranges::minmax(worn.parts);
  require(least >= 0 && most < 65534, "labels", "are not all from 0 to 65533", "number parts from 0");
  // The ranges of docs/render.md.
  require(size.first >= 1 && size.second >= 1 && size.first <= 16384 && size.second <= 16384, "size",
          "is not from 1 to 16384", "give (width, height) in pixels");
  require(samples >= 1 && samples <= 256, "samples", "is not from 1 to 256", "4 are usual");
  require(std::abs(azimuth) <= 36000 && std::abs(rotation) <= 36000, "azimuth, rotation", "are beyond 36000",
          "give degrees");
  require(elevation >= -90 && elevation <= 90, "elevation", "is not from -90 to 90", "give degrees");
  require(field_of_view == 0 || (field_of_view >= 1 && field_of_view <= 120), "field_of_view",
          "is neither 0 nor from 1 to 120", "give degrees, or 0 for an orthographic camera");
  require(share >= 0.01 && share <= 0.9, "share", "is not from 0.01 to 0.9", "0.45 is usual");
  require(crease >= 0 && crease <= 180, "crease", "is not from 0 to 180", "give degrees");
  SceneFile scene;
  scene.materials = materials_in(material, most + 1);
  scene.light = placed_light(light, rotation);
  scene.view = {azimuth, elevation, field_of_view, share};
  scene.size = {size.first, size.second, samples};
  scene.path = exact || shadows ? RenderPath::exact : RenderPath::reflectance_map;
  scene.shadows = shadows;
  scene.meshes.push_back(std::move(worn));
  return as_rendering(long_call([&](const Progress&) { return render(scene); }));
}

Rendering render_file(const std::filesystem::path& path, const std::optional<std::filesystem::path>& folder) {
  return as_rendering(
      long_call([&](const Progress&) { return render(folder ? read_scene(path, *folder) : read_scene(path)); }));
}

}  // namespace

void add_rendering(py::module_& core) {
  py::class_<Camera>(core, "Camera", "Where a picture was taken from; it looks along its -z.")
      .def_readonly("axes", &Camera::axes, "3 x 3, rows right, up and back (towards the viewer).")
      .def_readonly("position", &Camera::position, "Model units.")
      .def_readonly("half_height", &Camera::half_height,
                    "Of the picture: in model units when orthographic, else at distance 1.")
      .def_readonly("orthographic", &Camera::orthographic, "Whether rays are parallel.");

  py::class_<Rendering>(core, "Rendering", "An image and what is known of its pixels; row 0 is the top.")
      .def_readonly("image", &Rendering::image, "h x w x 3 float32, linear RGB, the background 0.")
      .def_readonly("normals", &Rendering::normals, "h x w x 3 float32, camera space, the background the zero vector.")
      .def_readonly("depth", &Rendering::depth, "h x w float32 along the view, model units, the background 0.")
      .def_readonly("mask", &Rendering::mask, "h x w float32, the share of each pixel that is covered.")
      .def_readonly("parts", &Rendering::parts, "h x w int32, the label of most of each pixel, -1 for none.")
      .def_readonly("camera", &Rendering::camera, "That framed the mesh.");

  core.def("render", &render_mesh, py::arg("mesh"), py::arg("material"), py::arg("labels") = py::none(), py::kw_only(),
           py::arg("light") = "studio", py::arg("rotation") = 0.0, py::arg("azimuth") = 35.0,
           py::arg("elevation") = 20.0, py::arg("field_of_view") = 0.0, py::arg("share") = 0.45,
           py::arg("size") = std::pair(256, 256), py::arg("samples") = 4, py::arg("exact") = false,
           py::arg("shadows") = false, py::arg("crease") = 40.0,
           "An image of a mesh whose parts wear materials, under the light of a real place (docs/render.md).\n\n"
           "material: a name, a file, a Material, or a list of them that the parts take in turn.\n"
           "labels: the part of each face; left out, all is one.\n"
           "light: a shipped one, a file (.exr, .hdr), or a map h x w x 3; rotation turns it, degrees.\n"
           "azimuth, elevation: of the viewer, degrees. field_of_view: degrees; 0, orthographic.\n"
           "share: of the frame that the mesh covers. size: (width, height).\n"
           "exact: sum over the light for every sample instead of reflectance maps; so with shadows.\n"
           "crease: edges below this angle are smooth, degrees.");
  core.def("render_scene", &render_file, py::arg("path"), py::arg("folder") = py::none(),
           "Renders a scene file as `partwise render` does; its files are relative to its folder, or another.");
  core.def("shipped_lights", &shipped_lights, "The names of the lights that ship.");
}

}  // namespace partwise::python
