#include "partwise/parts/planar/read_segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/imaging/png.h"
#include "partwise/parts/planar/read_shape.h"
#include "partwise/parts/planar/region.h"

namespace partwise {
namespace {

// The part of each pixel, -1 where there is none.
std::vector<int> labels_of(const Image& image, const std::string& place) {
  constexpr std::size_t most_colours = 4096;
  const std::size_t channels = static_cast<std::size_t>(image.channels), colours = channels < 3 ? 1 : 3;
  std::map<std::array<float, 3>, int> part_of;
  std::vector<int> labels(image.values.size() / channels, -1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const float* pixel = image.values.data() + i * channels;
    std::array<float, 3> colour{};
    std::copy_n(pixel, colours, colour.begin());
    const bool transparent = channels % 2 == 0 && pixel[channels - 1] == 0;
    if (transparent || colour == std::array<float, 3>{}) continue;
    labels[i] = part_of.try_emplace(colour, static_cast<int>(part_of.size())).first->second;
    if (part_of.size() > most_colours) {
      throw InputError(place, fmt::format("has more than {} colours", most_colours),
                       "give a label image, one colour a part, without smoothing");
    }
  }
  if (part_of.empty()) throw InputError(place, "has no part", "paint each part in a colour of its own, the rest black");
  return labels;
}

}  // namespace

PlanarSegmentation read_segmentation(const std::filesystem::path& path) {
  if (is_png_name(path)) return label_image_segmentation(read_png(path), path.string());
  PlanarSegmentation result{read_parts(path), {}};
  result.part.resize(result.polygons.size());
  std::iota(result.part.begin(), result.part.end(), 0);
  return result;
}

PlanarSegmentation label_image_segmentation(const Image& image, const std::string& place) {
  const int width = image.width, height = image.height;
  const std::vector<int> labels = labels_of(image, place);
  const auto label = [&](int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height ? -1 : labels[static_cast<std::size_t>(y) * width + x];
  };
  const auto name = [&](int x, int y) { return y * width + x; };
  DisjointSets regions(labels.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (label(x, y) < 0) continue;
      if (label(x + 1, y) == label(x, y)) regions.join(name(x, y), name(x + 1, y));
      if (label(x, y + 1) == label(x, y)) regions.join(name(x, y), name(x, y + 1));
    }
  }
  std::vector<Point2> corners;
  for (int y = 0; y <= height; ++y) {
    for (int x = 0; x <= width; ++x) corners.emplace_back(x, y);
  }
  std::map<int, std::vector<IndexEdge>> sides;  // of each region, which lies on their left
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (label(x, y) < 0) continue;
      const int corner = y * (width + 1) + x, below = corner + width + 1;
      std::vector<IndexEdge>& own = sides[regions.find(name(x, y))];
      if (label(x, y - 1) != label(x, y)) own.emplace_back(corner, corner + 1);
      if (label(x + 1, y) != label(x, y)) own.emplace_back(corner + 1, below + 1);
      if (label(x, y + 1) != label(x, y)) own.emplace_back(below + 1, below);
      if (label(x - 1, y) != label(x, y)) own.emplace_back(below, corner);
    }
  }
  PlanarSegmentation result;
  for (auto& [region, edges] : sides) {
    result.polygons.push_back(to_polygon(corners, trace_region(corners, std::move(edges))));
    result.part.push_back(labels[region]);
  }
  return result;
}

}  // namespace partwise
