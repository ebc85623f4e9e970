#include "partwise/parts/planar/resolvers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "partwise/geometry/orientation.h"
#include "partwise/parts/planar/hierarchical_concavity.h"

namespace partwise {
namespace {

// Counter-clockwise angle from one direction to another, above 0 and at most a full turn.
double turn(const Point2& from, const Point2& to) {
  const double angle = std::atan2(cross(from, to), from.dot(to));
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

double residual(const Point2& v, const Point2& p, const Point2& q, double angle) {
  return angle <= std::numbers::pi ? 0 : distance_to_segment(v, p, q);
}

}  // namespace

bool needs_resolver(const Corner& corner, double tolerance) { return !resolves(corner, {}, tolerance); }

bool resolves(const Corner& corner, std::span<const Point2> ends, double tolerance) {
  const Point2 first = corner.next - corner.at;
  const double whole = turn(first, corner.previous - corner.at);
  std::vector<std::pair<double, Point2>> spokes{{0, corner.next}, {whole, corner.previous}};
  for (const Point2& end : ends) {
    const double angle = turn(first, end - corner.at);
    if (angle < whole) spokes.emplace_back(angle, end);
  }
  std::sort(spokes.begin(), spokes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i + 1 < spokes.size(); ++i) {
    const auto& [from, p] = spokes[i];
    const auto& [to, q] = spokes[i + 1];
    if (residual(corner.at, p, q, to - from) > tolerance) return false;
  }
  return true;
}

std::vector<std::vector<int>> smallest_resolvers(const Corner& corner, std::span<const Point2> ends, double tolerance) {
  std::vector<std::vector<int>> sets;
  std::vector<int> rest;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (resolves(corner, ends.subspan(i, 1), tolerance)) {
      sets.push_back({static_cast<int>(i)});
    } else {
      rest.push_back(static_cast<int>(i));
    }
  }
  for (std::size_t k = 0; k < rest.size(); ++k) {
    for (std::size_t l = k + 1; l < rest.size(); ++l) {
      const Point2 both[] = {ends[rest[k]], ends[rest[l]]};
      if (resolves(corner, both, tolerance)) sets.push_back({rest[k], rest[l]});
    }
  }
  return sets;
}

}  // namespace partwise
