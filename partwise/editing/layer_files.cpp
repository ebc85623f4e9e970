#include "partwise/editing/layer_files.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <fmt/format.h>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/png.h"
#include "partwise/imaging/tone_mapping.h"

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
  const EnvironmentLight light = light_of(layers);
  write("normals.png", image_of((layers.found.normals[0] + 1) / 2), PngCodes::plain16);
  write("picture.png", image_of(layers.picture[0]), PngCodes::plain8);
  write("rendered.png", image_of(rendered(layers.found, range, layers.regions)[0].clamp(0, 1)), PngCodes::plain8);
  write_file(folder / "light.exr", encode_exr(light.radiance()));
  const at::Tensor rows = range.coefficients(layers.found.material);
  const LightTree tree(light);
  for (std::int64_t i = 0; i < rows.size(0); ++i) {
    const std::string number = i == 0 ? "" : fmt::format("-{}", i + 1);
    const Dsbrdf material(as_material(rows[i]));
    write_material(folder / ("material" + number + ".json"), {"found" + number, {}, material});
    Image ball = tone_map(material_ball(material, tree, ball_size), 1);
    for (float& value : ball.values) value /= 255;
    write("ball" + number + ".png", ball, PngCodes::plain8);
  }
}

}  // namespace partwise
