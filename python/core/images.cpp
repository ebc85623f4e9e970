// Images from and to files, and made ready for the eye.
#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "partwise/base/error.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/hdr.h"
#include "partwise/imaging/image_io.h"
#include "partwise/imaging/png.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise::python {
namespace {

void write_image(const std::filesystem::path& path, const py::object& given, bool shown) {
  const Image image = image_in(given, "image");
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const py::gil_scoped_release released;
  if (ending == ".png") return write_png(path, image, shown ? PngCodes::plain8 : PngCodes::srgb);
  if (ending != ".exr" && ending != ".hdr") {
    throw InputError(path.string(), "has an ending that is not known", "write .png, .exr or .hdr");
  }
  if (shown) throw InputError("shown", "is for .png", "write linear light to .exr and .hdr");
  if (ending == ".exr") return write_exr(path, image);
  if (image.channels != 3) {
    throw InputError("image", fmt::format("has {} channels", image.channels), "give 3, or write .exr");
  }
  write_hdr(path, image);
}

py::array tone_mapped(const py::object& given, const py::object& given_mask) {
  const Image linear = image_in(given, "image");
  const Image mask = given_mask.is_none() ? Image(linear.width, linear.height, 1, 1) : image_in(given_mask, "mask");
  if (mask.width != linear.width || mask.height != linear.height || mask.channels != 1) {
    throw InputError("mask", fmt::format("is {} x {} x {}", mask.height, mask.width, mask.channels),
                     fmt::format("give one that is {} x {}", linear.height, linear.width));
  }
  Image mapped = tone_map(linear, exposure_by_median(linear, mask));
  for (float& value : mapped.values) value /= 255;
  return image_out(std::move(mapped));
}

}  // namespace

void add_images(py::module_& core) {
  core.def(
      "read_image",
      [](const std::filesystem::path& path) {
        Image image;
        {
          const py::gil_scoped_release released;
          image = read_image(path);
        }
        return image_out(std::move(image));
      },
      py::arg("path"), "The linear light of a .exr, .hdr, .png, .jpg, .pgm or .ppm: h x w x c float32, grey h x w.");
  core.def("write_image", &write_image, py::arg("path"), py::arg("image"), py::kw_only(), py::arg("shown") = false,
           "Writes linear light to .exr (half), .hdr or .png (sRGB, 8 bits).\n\n"
           "shown: the values have their curve already, as tone_mapped() and edit() give them (.png alone).");
  core.def("tone_mapped", &tone_mapped, py::arg("image"), py::arg("mask") = py::none(),
           "Linear light for the eye, as `partwise render --png` writes it: the median of what the mask covers becomes "
           "0.18, gamma 2.2, values 0 to 1.");
}

}  // namespace partwise::python
