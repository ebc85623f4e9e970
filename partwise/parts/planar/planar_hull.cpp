#include "partwise/parts/planar/planar_hull.h"

#include <algorithm>
#include <numeric>

namespace partwise {

std::vector<int> planar_hull(std::span<const Eigen::Vector2d> points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    if (points[i].x() != points[j].x()) return points[i].x() < points[j].x();
    if (points[i].y() != points[j].y()) return points[i].y() < points[j].y();
    return i < j;
  });
  order.erase(std::unique(order.begin(), order.end(), [&](int i, int j) { return points[i] == points[j]; }),
              order.end());
  if (order.size() < 3) return order;

  std::vector<int> hull(2 * order.size());
  std::size_t k = 0;
  const auto push = [&](int i, std::size_t keep) {
    while (k >= keep && orientation(points[hull[k - 2]], points[hull[k - 1]], points[i]) <= 0) --k;
    hull[k++] = i;
  };
  for (int i : order) push(i, 2);
  const std::size_t lower = k + 1;
  for (auto i = order.rbegin() + 1; i != order.rend(); ++i) push(*i, lower);
  hull.resize(k - 1);
  return hull;
}

}  // namespace partwise
