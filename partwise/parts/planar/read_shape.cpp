#include "partwise/parts/planar/read_shape.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/contours.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

std::vector<float> coverage(const Image& image) {
  std::vector<float> values(static_cast<std::size_t>(image.width) * image.height);
  const bool colour = image.channels >= 3, alpha = image.channels % 2 == 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float* pixel = image.values.data() + i * image.channels;
    const float luminance = colour ? 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2] : pixel[0];
    values[i] = srgb_from_linear(luminance) * (alpha ? pixel[image.channels - 1] : 1);
  }
  return values;
}

}  // namespace

bool is_png_name(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".png";
}

PolygonFile read_shape(const std::filesystem::path& path, const PolygonReadSettings& settings) {
  if (!is_png_name(path)) return read_polygons(path, settings);
  return mask_shape(read_png(path), settings.repair, path.string());
}

PolygonFile mask_shape(const Image& mask, bool repair, const std::string& place) {
  Polygons polygons = trace_contours(coverage(mask), mask.width, mask.height);
  if (polygons.empty()) {
    throw InputError(place, "has no pixel above one half", "paint the inside white, the outside black");
  }
  return valid_polygons(std::move(polygons), repair, place);
}

}  // namespace partwise
