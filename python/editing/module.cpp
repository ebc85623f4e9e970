// The extension module partwise._editing, which needs libtorch: partwise.edit and photo_normals.
// python/partwise/editing.py loads it.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "errors.h"
#include "lights.h"
#include "long_call.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/base/shared_files.h"
#include "partwise/editing/edit_photo.h"
#include "photo_normals.h"
#include "photos.h"

namespace partwise::python {
namespace {

struct Edit {
  py::array image, normals, light, materials;
  double l2_reconstruction = 0;
};

struct Found {
  PhotoLayers layers;
  std::vector<DsbrdfCoefficients> materials;
};

Found found_in(const EditingNetworks& networks, const Photo& photo, bool refine, const Progress& progress) {
  Found found{.layers = read_layers(networks, photo, {.refine = refine, .refinement = {}}, progress), .materials = {}};
  const at::Tensor rows = networks.range().coefficients(found.layers.found.material);
  for (std::int64_t i = 0; i < rows.size(0); ++i) found.materials.push_back(as_material(rows[i]));
  return found;
}

py::array normals_out(const at::Tensor& normals) {
  const at::Tensor pixels = normals[0].detach().permute({1, 2, 0}).contiguous();
  std::vector<float> values(pixels.data_ptr<float>(), pixels.data_ptr<float>() + pixels.numel());
  return array_out(std::move(values), {pixels.size(0), pixels.size(1), 3});
}

Edit edit(const py::object& given, const py::object& masks, const std::optional<std::vector<py::object>>& coefficients,
          const py::object& other, const py::object& other_masks, const py::object& light, bool refine,
          const std::optional<std::filesystem::path>& weights) {
  const Photo photo = photo_in(given, masks);
  std::vector<DsbrdfCoefficients> wanted;
  for (const py::object& each : coefficients.value_or(std::vector<py::object>())) {
    wanted.emplace_back(
        Eigen::Map<const DsbrdfCoefficients>(real_array(each, "material", {dsbrdf_size}, "of 108 numbers").data()));
  }
  const std::optional<Photo> source = other.is_none() ? std::nullopt : std::optional(photo_in(other, other_masks));
  std::optional<EnvironmentLight> new_light;
  if (!light.is_none()) new_light = exposed_for_grey_card(light_in(light));
  Found found;
  Image result = long_call([&](const Progress& progress) {
    const EditingNetworks networks = read_editing_networks(weights.value_or(shared_file("models/networks/editing.pt")));
    if (source) wanted = found_in(networks, *source, refine, progress).materials;
    if (wanted.size() == 1) wanted.resize(photo.regions.size(), wanted.front());
    if (wanted.size() != photo.regions.size()) {
      throw InputError("material", fmt::format("{} are given for {} regions", wanted.size(), photo.regions.size()),
                       "give one for all, or one for each mask, in their order");
    }
    found = found_in(networks, photo, refine, progress);
    return edited(photo, found.layers, wanted, new_light);
  });
  return {.image = image_out(std::move(result)),
          .normals = normals_out(found.layers.found.normals),
          .light = image_out(light_of(found.layers).radiance()),
          .materials = rows_out(found.materials, dsbrdf_size),
          .l2_reconstruction = found.layers.error};
}

}  // namespace
}  // namespace partwise::python

PYBIND11_MODULE(_editing, editing) {
  using namespace partwise::python;
  translate_errors(py::module_::import("partwise._core"));
  py::class_<Edit>(editing, "Edit", "A photo in another material, from edit(), and what was found in the photo.")
      .def_readonly("image", &Edit::image, "h x w x 3 float32 as shown, 0 to 1; 4 where the photo has transparency.")
      .def_readonly("normals", &Edit::normals, "s x s x 3 float32, camera space, of the square about the object.")
      .def_readonly("light", &Edit::light, "64 x 128 x 3 float32, linear radiance.")
      .def_readonly("materials", &Edit::materials, "r x 108 float64, the material of each region.")
      .def_readonly("l2_reconstruction", &Edit::l2_reconstruction,
                    "Mean squared error of the photo rendered anew from these, 0 to 255 squared.");
  editing.def("edit", &edit, py::arg("photo"), py::arg("masks"), py::arg("coefficients"), py::arg("other"),
              py::arg("other_masks"), py::arg("light"), py::arg("refine"), py::arg("weights"),
              "What partwise.edit does, with materials as their 108 numbers.");
  add_photo_normals(editing);
}
