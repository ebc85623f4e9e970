#include "materials.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "lights.h"
#include "long_call.h"
#include "partwise/appearance/material/fit_dsbrdf.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/material_ball.h"

namespace partwise::python {
namespace {

Material named_material(const std::string& name) {
  std::shared_ptr<const Brdf> brdf = long_call([&](const Progress&) { return find_material(name); });
  return {is_material_file(name) ? std::filesystem::path(name).stem().string() : name, std::move(brdf), {}};
}

Material fitted_material(const std::filesystem::path& path) {
  return long_call([&](const Progress&) -> Material {
    const HalfAngleTable measured = mean_over_phi(read_measured(path));
    const auto fit = std::make_shared<const Dsbrdf>(fit_dsbrdf(measured));
    return {path.stem().string(), fit, log_rmse(measured, *fit)};
  });
}

Material material_of_numbers(const py::object& coefficients, const std::string& name) {
  const DoubleArray numbers = real_array(coefficients, "coefficients", {dsbrdf_size}, "of 108 numbers");
  return {name, std::make_shared<const Dsbrdf>(Eigen::Map<const DsbrdfCoefficients>(numbers.data())), {}};
}

const Dsbrdf& fit_of(const Material& material) {
  const auto* fit = dynamic_cast<const Dsbrdf*>(material.brdf.get());
  if (fit == nullptr) throw InputError(material.name, "is measured, not fitted", "fit it with fit_material");
  return *fit;
}

py::object coefficients_of(const Material& material) {
  const auto* fit = dynamic_cast<const Dsbrdf*>(material.brdf.get());
  if (fit == nullptr) return py::none();
  const DsbrdfCoefficients& numbers = fit->coefficients();
  return vector_out(std::vector<double>(numbers.begin(), numbers.end()));
}

// Unit vectors, one or n.
FloatArray directions_in(const py::object& given, const std::string& name) {
  const py::array array = py::array::ensure(given);
  const bool single = array && array.ndim() == 1;
  FloatArray directions = float_array(given, name, single ? Shape{3} : Shape{-1, 3}, "n x 3, or of 3 numbers");
  for (py::ssize_t i = 0; i < directions.size() / 3; ++i) {
    const float length = Eigen::Map<const Eigen::Vector3f>(directions.data() + 3 * i).norm();
    if (std::abs(length - 1) < 1e-3f) continue;
    throw InputError(fmt::format("{}[{}]", name, i), fmt::format("has the length {}", length), "give unit vectors");
  }
  return directions;
}

py::array evaluate(const Material& material, const py::object& to_light, const py::object& to_viewer) {
  const FloatArray lights = directions_in(to_light, "to_light"), viewers = directions_in(to_viewer, "to_viewer");
  const py::ssize_t a = lights.size() / 3, b = viewers.size() / 3, count = a == 1 ? b : a;
  if (a != b && a != 1 && b != 1) {
    throw InputError("to_viewer", fmt::format("has {} directions, to_light {}", b, a), "give as many, or one");
  }
  std::vector<float> values(static_cast<std::size_t>(3 * count));
  {
    const py::gil_scoped_release released;
    using Direction = Eigen::Map<const Eigen::Vector3f>;
    for (py::ssize_t i = 0; i < count; ++i) {
      Eigen::Map<Eigen::Vector3f>(values.data() + 3 * i) = (*material.brdf)(
          Direction(lights.data() + (a == 1 ? 0 : 3 * i)), Direction(viewers.data() + (b == 1 ? 0 : 3 * i)));
    }
  }
  const bool single = lights.ndim() == 1 && viewers.ndim() == 1;
  return array_out(std::move(values), single ? Shape{3} : Shape{count, 3});
}

py::array ball(const py::object& given, const py::object& given_light, int size) {
  const Material material = material_in(given, "material");
  const EnvironmentLight light = light_in(given_light);
  if (size < 1) throw InputError("size", fmt::format("{} is less than 1", size), "give a number of pixels");
  return image_out(long_call([&](const Progress&) { return material_ball(*material.brdf, LightTree(light), size); }));
}

}  // namespace

Material material_in(const py::handle& given, const std::string& name) {
  if (py::isinstance<Material>(given)) return given.cast<Material>();
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__")) {
    return named_material(py::str(given).cast<std::string>());
  }
  throw InputError(name, "is no material", "give a name, a file, or a partwise.Material");
}

void add_materials(py::module_& core) {
  py::class_<Material>(core, "Material", "How a surface reflects light.")
      .def(py::init(&material_of_numbers), py::arg("coefficients"), py::arg("name") = "",
           "Of the 108 numbers of a fit.")
      .def_readonly("name", &Material::name, "As it was asked for, or the name of its file.")
      .def_readonly("log_rmse", &Material::log_rmse, "Of fit_material(): how far it is from what was measured.")
      .def_property_readonly("coefficients", &coefficients_of,
                             "A copy of its 108 numbers, float64; None for a measured material.")
      .def("evaluate", &evaluate, py::arg("to_light"), py::arg("to_viewer"),
           "Linear RGB in 1/sr without the cosine, n x 3 float32.\n\n"
           "to_light, to_viewer: unit vectors, n x 3 or one for all, in the frame of the surface with normal +z.")
      .def("__repr__", [](const Material& material) { return fmt::format("<partwise.Material {}>", material.name); });

  core.def(
      "material", [](const py::object& name) { return material_in(name, "name"); }, py::arg("name"),
      "A shipped material by its name, or a file: fitted (.json) or measured (.binary, .h5).");
  core.def("shipped_materials", &shipped_materials, "The names of the materials that ship.");
  core.def("fit_material", &fitted_material, py::arg("path"),
           "The fit of a measured material, a MERL .binary or a Neural-BRDF .h5 (docs/material.md).");
  core.def(
      "write_material",
      [](const std::filesystem::path& path, const Material& material) {
        write_material(path, {material.name, material.log_rmse, fit_of(material)});
      },
      py::arg("path"), py::arg("material"), "Writes a fitted material, .json.");
  core.def("material_ball", &ball, py::arg("material"), py::kw_only(), py::arg("light") = "venice",
           py::arg("size") = 256, "A ball in a material: size x size x 4 float32, linear RGB and alpha.");
}

}  // namespace partwise::python
