#include "partwise/parts/solid/space_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

double radical_inverse(int base, int n) {
  double value = 0, digit = 1.0 / base;
  for (; n > 0; n /= base, digit /= base) value += digit * (n % base);
  return value;
}

}  // namespace

std::vector<int> points_inside(const Vertices& points, const Mesh& hull) {
  const auto planes = hull_planes(hull);
  const Point low = hull.vertices.colwise().minCoeff(), high = hull.vertices.colwise().maxCoeff();
  std::vector<int> inside;
  for (int i = 0; i < points.rows(); ++i) {
    const double x = points(i, 0), y = points(i, 1), z = points(i, 2);
    if (x < low[0] || x > high[0] || y < low[1] || y > high[1] || z < low[2] || z > high[2]) continue;
    inside.push_back(i);
  }
  // Plane by plane: most points outside fall to the first few.
  for (const auto& plane : planes.rowwise()) {
    const double a = plane[0], b = plane[1], c = plane[2], d = plane[3];
    std::size_t kept = 0;
    for (int i : inside) {
      inside[kept] = i;
      kept += a * points(i, 0) + b * points(i, 1) + c * points(i, 2) <= d;
    }
    inside.resize(kept);
    if (kept == 0) break;
  }
  return inside;
}

SpaceSamples sample_space(const SurfaceQuery& surface, bool closed, const Mesh& hull, int count) {
  const Point low = hull.vertices.colwise().minCoeff(), size = hull.vertices.colwise().maxCoeff() - low;
  SpaceSamples samples;
  const double filled = signed_volume(hull) / std::max(size.prod(), 1e-300);
  const int draws = static_cast<int>(std::min(count / std::max(filled, 0.01), 100.0 * count));
  Vertices drawn(draws, 3);
  for (int i = 0; i < draws; ++i)
    drawn.row(i) =
        low + size.cwiseProduct(Point(radical_inverse(2, i + 1), radical_inverse(3, i + 1), radical_inverse(5, i + 1)));
  const std::vector<int> inside = points_inside(drawn, hull);
  std::vector<char> in_solid(inside.size(), 0);
  if (closed) {
    tbb::parallel_for(std::size_t{0}, inside.size(),
                      [&](std::size_t i) { in_solid[i] = surface.contains(drawn.row(inside[i])); });
  }
  std::vector<int> air, solid;
  for (std::size_t i = 0; i < inside.size(); ++i) (in_solid[i] ? solid : air).push_back(inside[i]);
  samples.air = drawn(air, Eigen::all);
  samples.solid = drawn(solid, Eigen::all);
  samples.volume = size.prod() / std::max(draws, 1);
  return samples;
}

}  // namespace partwise
