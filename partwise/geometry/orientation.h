// On which side of a line a point lies, exactly: the sign of the double area of the triangle (a, b, c), positive when
// it runs counter-clockwise. A floating-point filter decides nearly always; what it cannot decide is summed as an
// expansion without rounding (Shewchuk 1997, sections 2 and 4). Exact unless products of coordinates overflow or
// underflow.
#pragma once

#include <Eigen/Core>

namespace partwise {

using Point2 = Eigen::Vector2d;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// 1: counter-clockwise, -1: clockwise, 0: on one line.
int orientation(const Point2& a, const Point2& b, const Point2& c);

// True only when d certainly lies inside the circle through a, b, c, which run counter-clockwise. Within the error of
// the computation it is false, so that whoever flips edges by it never flips one back.
bool inside_circle(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

}  // namespace partwise
