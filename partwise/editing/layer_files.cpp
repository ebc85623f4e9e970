#include "partwise/editing/layer_files.h"

#include <ATen/Functions.h>
#include <fmt/format.h>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/editing/layer_pictures.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

constexpr int ball_size = 128;

}  // namespace

void write_layers(const std::filesystem::path& folder, const PhotoLayers& layers, const MaterialRange& range) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made", "name another folder");
  const auto write = [&](const std::string& name, const Image& image, PngCodes codes) {
    write_file(folder / name, encode_png(image, codes));
  };
  write("normals.png", normals_picture(layers), PngCodes::plain16);
  write("picture.png", seen_picture(layers), PngCodes::plain8);
  write("rendered.png", rendered_picture(layers, range), PngCodes::plain8);
  write_file(folder / "light.exr", encode_exr(light_of(layers).radiance()));
  const at::Tensor rows = range.coefficients(layers.found.material);
  for (int i = 0; i < static_cast<int>(rows.size(0)); ++i) {
    const std::string number = i == 0 ? "" : fmt::format("-{}", i + 1);
    write_material(folder / ("material" + number + ".json"), {"found" + number, {}, Dsbrdf(as_material(rows[i]))});
    write("ball" + number + ".png", ball_picture(layers, range, i, ball_size), PngCodes::plain8);
  }
}

}  // namespace partwise
