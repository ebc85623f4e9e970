#include "partwise/normals/truth/normal_detail.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Eigen::Vector3d normal_of(const Image& normals, int x, int y) {
  return Eigen::Map<const Eigen::Vector3f>(normals.pixel(x, y)).cast<double>();
}

double turn_at(const Image& normals, int x, int y) {
  constexpr int beside[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const Eigen::Vector3d here = normal_of(normals, x, y);
  double most = 0;
  for (const auto& [dx, dy] : beside) {
    if (x + dx < 0 || x + dx >= normals.width || y + dy < 0 || y + dy >= normals.height) continue;
    const Eigen::Vector3d there = normal_of(normals, x + dx, y + dy);
    most = std::max(most, std::atan2(here.cross(there).norm(), here.dot(there)));  // 0 for a zero vector
  }
  return most * 180 / std::numbers::pi;
}

void mark_about(Mask& mask, int x, int y, int distance) {
  for (int j = std::max(0, y - distance); j <= std::min(mask.height - 1, y + distance); ++j) {
    for (int i = std::max(0, x - distance); i <= std::min(mask.width - 1, x + distance); ++i) mask.pixel(i, j)[0] = 1;
  }
}

Mask both(const Mask& a, const Mask& b) {
  Mask result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = a.values[i] > 0.5f && b.values[i] > 0.5f ? 1 : 0;
  }
  return result;
}

}  // namespace

DetailRegions detail_regions(const Image& truth, const DetailSettings& settings) {
  PARTWISE_CHECK(truth.channels, ==, 3);
  PARTWISE_CHECK(settings.edge_distance, >=, 0);
  PARTWISE_CHECK(settings.edge_turn, >=, settings.curved_turn);
  const Mask none(truth.width, truth.height, 1);
  DetailRegions regions{none, none, none};
  std::vector<double> turns(none.values.size());
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const double turn = turn_at(truth, x, y);
      turns[static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) + static_cast<std::size_t>(x)] = turn;
      if (turn >= settings.edge_turn) mark_about(regions.edges, x, y, settings.edge_distance);
    }
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const float* n = truth.values.data() + 3 * i;
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) {
      regions.edges.values[i] = 0;
    } else if (regions.edges.values[i] == 0) {
      (turns[i] >= settings.curved_turn ? regions.curved : regions.smooth).values[i] = 1;
    }
  }
  return regions;
}

void DetailMeasure::add(const Image& normals, const Image& truth, const DetailSettings& settings) {
  add(normals, truth, Mask(truth.width, truth.height, 1, 1), settings);
}

void DetailMeasure::add(const Image& normals, const Image& truth, const Mask& mask, const DetailSettings& settings) {
  all.add(normals, truth, mask);
  const DetailRegions regions = detail_regions(truth, settings);
  edges.add(normals, truth, both(regions.edges, mask));
  curved.add(normals, truth, both(regions.curved, mask));
  smooth.add(normals, truth, both(regions.smooth, mask));
}

void DetailMeasure::add(const DetailMeasure& other) {
  all.add(other.all);
  edges.add(other.edges);
  curved.add(other.curved);
  smooth.add(other.smooth);
}

}  // namespace partwise
