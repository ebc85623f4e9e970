// The vector from the nearest point of a segment or triangle to p (Ericson 2004, section 5.1). Triangles without area
// are their longest side; a segment may be a point.
#pragma once

#include "partwise/geometry/mesh.h"

namespace partwise {

Point offset_from_segment(const Point& p, const Point& a, const Point& b);
Point offset_from_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace partwise
