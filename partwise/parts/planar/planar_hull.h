// The convex hull of points in the plane as indices, counter-clockwise, from the leftmost lowest point; points on an
// edge of the hull and repeated points are left out (Andrew 1979). Exact. O(n log n).
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/geometry/orientation.h"

namespace partwise {

std::vector<int> planar_hull(std::span<const Eigen::Vector2d> points);

}  // namespace partwise
