// Solid angles of triangles, and how often a surface winds about a point by them (van Oosterom, Strackee 1983).
#pragma once

#include <array>

#include "partwise/geometry/mesh.h"

namespace partwise {

using Triangle = std::array<Point, 3>;

// Of a triangle as seen from the origin, in steradians: positive where its corners run clockwise, that is from within a
// surface of such triangles that run counter-clockwise from outside; 0 where the origin lies in its plane and off it.
double solid_angle(const Triangle& triangle);

// The signed number of times that the closed surface winds about p: a whole number off the surface, to rounding,
// between two of them on it. Open surfaces give a fraction. O(m); SurfaceQuery::winding_number is for many points.
double solid_angle_winding(const Mesh& surface, const Point& p);

}  // namespace partwise
