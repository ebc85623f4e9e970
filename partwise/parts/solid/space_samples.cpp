#include "partwise/parts/solid/space_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace partwise {
namespace {

double radical_inverse(int base, int n) {
  double value = 0, digit = 1.0 / base;
  for (; n > 0; n /= base, digit /= base) value += digit * (n % base);
  return value;
}

}  // namespace

SpaceSamples sample_space(const SurfaceQuery& surface, const Mesh& hull, int count) {
  const Point low = hull.vertices.colwise().minCoeff(), size = hull.vertices.colwise().maxCoeff() - low;
  SpaceSamples samples;
  const double filled = signed_volume(hull) / std::max(size.prod(), 1e-300);
  const int draws = static_cast<int>(std::min(count / std::max(filled, 0.01), 100.0 * count));
  Vertices drawn(draws, 3);
  for (int i = 0; i < draws; ++i)
    drawn.row(i) =
        low + size.cwiseProduct(Point(radical_inverse(2, i + 1), radical_inverse(3, i + 1), radical_inverse(5, i + 1)));
  std::vector<int> inside = PointTree(drawn).inside(hull);
  std::sort(inside.begin(), inside.end());
  std::vector<char> in_solid(inside.size(), 0);
  tbb::parallel_for(std::size_t{0}, inside.size(),
                    [&](std::size_t i) { in_solid[i] = surface.contains(drawn.row(inside[i])); });
  std::vector<int> air, solid;
  for (std::size_t i = 0; i < inside.size(); ++i) (in_solid[i] ? solid : air).push_back(inside[i]);
  samples.air = PointTree(drawn(air, Eigen::all));
  samples.solid = PointTree(drawn(solid, Eigen::all));
  samples.volume = size.prod() / std::max(draws, 1);
  return samples;
}

}  // namespace partwise
