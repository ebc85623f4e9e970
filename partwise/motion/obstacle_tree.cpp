#include "partwise/motion/obstacle_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/closest_point.h"
#include "partwise/motion/insert_nearest.h"

namespace partwise {
namespace {

BoxTree::Box box_of(const Simplex& simplex) {
  const auto& [a, b, c] = simplex;
  return {a.cwiseMin(b).cwiseMin(c).transpose(), a.cwiseMax(b).cwiseMax(c).transpose()};
}

Point offset(const Point& p, const Simplex& simplex) {
  const auto& [a, b, c] = simplex;
  return b == c ? offset_from_segment(p, a, b) : offset_from_triangle(p, a, b, c);
}

constexpr double anywhere = std::numeric_limits<double>::infinity();

}  // namespace

ObstacleTree::ObstacleTree(const std::vector<std::vector<Simplex>>& obstacles) {
  std::vector<BoxTree::Box> bounds;
  for (const auto& simplices : obstacles) {
    PARTWISE_CHECK(simplices.size(), >, 0u);
    std::vector<BoxTree::Box> boxes;
    std::ranges::transform(simplices, std::back_inserter(boxes), box_of);
    obstacles_.push_back({simplices, BoxTree(std::move(boxes))});
    bounds.push_back(obstacles_.back().tree.bounds());
  }
  boxes_ = BoxTree(std::move(bounds));
}

NearestPoint ObstacleTree::nearest(const Point& p, int number, double bound2) const {
  const Obstacle& obstacle = obstacles_[static_cast<std::size_t>(number)];
  NearestPoint best;
  obstacle.tree.near(p.transpose(), bound2, [&](int simplex, double bound) {
    const Point to = offset(p, obstacle.simplices[static_cast<std::size_t>(simplex)]);
    const double squared = to.squaredNorm();
    if (squared > bound) return bound;
    best = {number, std::sqrt(squared), to};
    return squared;
  });
  return best;
}

NearestPoint ObstacleTree::nearest(const Point& p, int obstacle) const { return nearest(p, obstacle, anywhere); }

std::vector<int> ObstacleTree::boxes_around(const Point& p) const {
  std::vector<int> numbers;
  boxes_.around(p.transpose(), [&](int number) { numbers.push_back(number); });
  std::ranges::sort(numbers);
  return numbers;
}

std::vector<NearestPoint> ObstacleTree::nearest_obstacles(const Point& p, int count) const {
  const auto wanted = static_cast<std::size_t>(count);
  std::vector<NearestPoint> found;
  boxes_.near(p.transpose(), anywhere, [&](int number, double bound2) {
    const NearestPoint next = nearest(p, number, bound2);
    if (next.obstacle < 0) return bound2;
    insert_nearest(found, next, wanted);
    return found.size() == wanted ? found.back().offset.squaredNorm() : bound2;
  });
  return found;
}

}  // namespace partwise
