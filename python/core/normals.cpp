// partwise.normals_from_depth: ground truth of normals from pictures of depth; normals in files.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/normal_files.h"

namespace partwise::python {
namespace {

// Missing depths may be NaN, so that the array is not looked through for numbers that are not finite.
Image depth_in(const py::object& given) {
  const py::array array = py::array::ensure(given);
  if (!array || array.ndim() != 2 || array.size() == 0 || array.dtype().kind() != 'f') {
    throw InputError("depth", "is no picture of depth", "give an array h x w of real numbers, in metres");
  }
  const auto depths = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
  Image depth(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), 1);
  depth.values.assign(depths.data(), depths.data() + depths.size());
  return depth;
}

py::array normals(const py::object& given, double focal, std::optional<std::pair<double, double>> centre,
                  double noise) {
  const Image depth = depth_in(given);
  if (!(std::isfinite(focal) && focal > 0)) throw InputError("focal", "is not above 0", "give it in pixels");
  if (!(std::isfinite(noise) && noise >= 0)) throw InputError("noise", "is below 0", "give 0 for exact depths");
  const auto [x, y] = centre.value_or(std::pair((depth.width - 1) / 2.0, (depth.height - 1) / 2.0));
  if (!std::isfinite(x) || !std::isfinite(y)) throw InputError("centre", "is not finite", "give (column, row)");
  const PinholeCamera camera = {.focal_x = focal, .focal_y = focal, .centre_x = x, .centre_y = y};
  return image_out(long_call(
      [&](const Progress& progress) { return normals_from_depth(depth, camera, {.noise = noise}, progress); }));
}

void write(const std::filesystem::path& path, const py::object& given, int bits) {
  const Image normals = image_in(given, "normals");
  if (normals.channels != 3) {
    throw InputError("normals", fmt::format("has {} channels", normals.channels), "give an array h x w x 3");
  }
  if (bits != 8 && bits != 16) throw InputError("bits", fmt::format("is {}", bits), "give 8 or 16");
  const py::gil_scoped_release released;
  write_normals(path, normals, bits == 8 ? NormalBits::eight : NormalBits::sixteen);
}

}  // namespace

void add_normals(py::module_& core) {
  core.def("normals_from_depth", &normals, py::arg("depth"), py::arg("focal"), py::arg("centre") = py::none(),
           py::kw_only(), py::arg("noise") = DepthNormalSettings().noise,
           "Normals in camera space of a picture of depth: h x w x 3 float32, zero where too little is known.\n\n"
           "depth: h x w, metres; 0 or less or not finite where it is missing.\n"
           "focal: pixels. centre: (column, row), left out the middle.\n"
           "noise: standard deviation of the inverse depth, 1/m; 0 for exact depths, left out a Kinect's.");
  core.def(
      "read_normals",
      [](const std::filesystem::path& path) {
        return image_out(long_call([&](const Progress&) { return read_normals(path); }));
      },
      py::arg("path"), "The normals of a .png or .exr: h x w x 3 float32 of unit length, zero where there is none.");
  core.def("write_normals", &write, py::arg("path"), py::arg("normals"), py::kw_only(), py::arg("bits") = 16,
           "Writes normals, h x w x 3, as they are to .exr, or as (n + 1) / 2 to .png.\n\n"
           "bits: of a .png, a channel: 8 or 16.");
}

}  // namespace partwise::python
