#include "partwise/normals/truth/normal_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

#include "partwise/appearance/rendering/channel_files.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

constexpr float shortest = 0.5f;
const std::array<std::string, 3> exr_channels{"X", "Y", "Z"};

bool is_exr(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".exr" && ending != ".png") {
    throw InputError(path.string(), "has the ending of no file of normals", "use .png or .exr");
  }
  return ending == ".exr";
}

}  // namespace

void write_normals(const std::filesystem::path& path, const Image& normals, NormalBits bits) {
  PARTWISE_CHECK(normals.channels, ==, 3);
  if (is_exr(path)) {
    const ExrLayer layer{normals, {exr_channels.begin(), exr_channels.end()}};
    return write_exr(path, {&layer, 1});
  }
  write_file(path, encode_normals(normals, bits == NormalBits::eight ? PngCodes::plain8 : PngCodes::plain16));
}

Image read_normals(const std::filesystem::path& path) {
  const bool exr = is_exr(path);
  Image normals = exr ? read_exr(path, exr_channels) : read_plain_png(path);
  if (normals.channels != 3) {
    throw InputError(path.string(), fmt::format("has {} channels, not 3", normals.channels),
                     "give a picture of normals");
  }
  for (std::size_t i = 0; i < normals.values.size(); i += 3) {
    float* n = normals.values.data() + i;
    for (int k = 0; k < 3 && !exr; ++k) n[k] = 2 * n[k] - 1;
    const float length = std::hypot(n[0], n[1], n[2]);
    const float scale = length >= shortest && std::isfinite(length) ? 1 / length : 0;
    for (int k = 0; k < 3; ++k) n[k] = scale > 0 ? scale * n[k] : 0;
  }
  return normals;
}

}  // namespace partwise
