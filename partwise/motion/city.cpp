#include "partwise/motion/city.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/geometry/polygon_validity.h"

namespace partwise {
namespace {

constexpr double earth_radius = 6371008.8;  // metres, mean

void project(Ring& ring, const Eigen::Vector2d& centre) {
  constexpr double per_degree = earth_radius * std::numbers::pi / 180;
  ring.rowwise() -= centre.transpose();
  ring.col(0) *= per_degree * std::cos(centre.y() * std::numbers::pi / 180);
  ring.col(1) *= per_degree;
}

// 0 for a footprint around the origin.
double distance_from_centre(const Polygons& polygons) {
  double nearest = std::numeric_limits<double>::infinity();
  bool around = false;
  const auto see = [&](const Ring& ring) {
    for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
      const Eigen::RowVector2d a = ring.row(j), ab = ring.row(i) - a;
      const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * ab).norm());
      if ((ring(i, 1) > 0) != (ring(j, 1) > 0)) around ^= a.x() - a.y() / ab.y() * ab.x() > 0;
    }
  };
  for (const Polygon& polygon : polygons) {
    see(polygon.outer);
    for (const Ring& hole : polygon.holes) see(hole);
  }
  return around ? 0 : nearest;
}

}  // namespace

City read_city(const std::filesystem::path& path, int limit) {
  Polygons polygons = read_parts(path);
  const Eigen::AlignedBox2d box = bounding_box(polygons);
  if (polygons.empty()) throw InputError(path.string(), "holds no polygon", "give building footprints");
  City city;
  city.centre = box.center();
  for (Polygon& polygon : polygons) {
    project(polygon.outer, city.centre);
    for (Ring& hole : polygon.holes) project(hole, city.centre);
    Polygons footprint = {std::move(polygon)};
    if (find_fault(footprint)) {
      try {
        footprint = repair_polygons(footprint, path.string());
      } catch (const InputError&) {
        continue;  // nothing with an area is left
      }
    }
    if (!footprint.empty()) city.footprints.push_back(std::move(footprint));
  }
  if (city.footprints.empty()) throw InputError(path.string(), "no polygon has an area", "give building footprints");
  if (limit <= 0 || static_cast<std::size_t>(limit) >= city.footprints.size()) return city;

  std::vector<double> distances;
  for (const Polygons& each : city.footprints) distances.push_back(distance_from_centre(each));
  std::vector<std::size_t> order(distances.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return distances[i]; });
  order.resize(static_cast<std::size_t>(limit));
  std::ranges::sort(order);
  std::vector<Polygons> kept;
  for (const std::size_t i : order) kept.push_back(std::move(city.footprints[i]));
  city.footprints = std::move(kept);
  return city;
}

}  // namespace partwise
