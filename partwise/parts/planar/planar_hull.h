// The convex hull of points in the plane as indices, counter-clockwise, from the leftmost lowest point; points on an
// edge of the hull and repeated points are left out (Andrew 1979). O(n log n).
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace partwise {

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<int> planar_hull(std::span<const Eigen::Vector2d> points);

}  // namespace partwise
