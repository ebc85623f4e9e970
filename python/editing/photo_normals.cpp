#include "photo_normals.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "arrays.h"
#include "long_call.h"
#include "partwise/base/shared_files.h"
#include "partwise/normals/prediction/photo_normals.h"
#include "photos.h"

namespace partwise::python {
namespace {

py::array normals(const py::object& given, const py::object& masks,
                  const std::optional<std::filesystem::path>& weights) {
  const Photo photo = photo_in(given, masks);
  return image_out(long_call([&](const Progress&) {
    return photo_normals(read_normal_predictor(weights.value_or(shared_file("models/networks/objects.pt"))), photo);
  }));
}

py::array normals_of_scene(const py::object& given, const std::optional<std::filesystem::path>& weights) {
  const Image shown = shown_in_whole(given);
  return image_out(long_call([&](const Progress&) {
    return scene_normals(read_scene_predictor(weights.value_or(shared_file("models/networks/scenes.pt"))), shown);
  }));
}

}  // namespace

void add_photo_normals(py::module_& editing) {
  editing.def("photo_normals", &normals, py::arg("photo"), py::arg("masks"), py::arg("weights"),
              "What partwise.photo_normals does, with a list for the mask.");
  editing.def("scene_normals", &normals_of_scene, py::arg("photo"), py::arg("weights"),
              "What partwise.scene_normals does.");
}

}  // namespace partwise::python
