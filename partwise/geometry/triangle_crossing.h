// Whether surfaces cross, and whether one encloses another, with the predicates of segments and triangles in double
// precision. Faces that lie in one plane, to rounding, do not cross.
#pragma once

#include "partwise/geometry/solid_angle.h"

namespace partwise {

// True when the segment meets the closed triangle and its ends lie on different sides of its plane, or one on it.
bool segment_crosses_triangle(const Point& p, const Point& q, const Triangle& triangle);

// Two triangles without a common vertex.
bool triangles_cross(const Triangle& a, const Triangle& b);

// True when two faces of the mesh cross that share no vertex, or share one and cross elsewhere. Every pair whose boxes
// meet is tested: O(m^2) for box tests, in parallel.
bool crosses_itself(const Mesh& mesh);

// True when no face of `inner` crosses a face of the closed mesh `outer`, and outer winds about every component of
// inner once or more. Every pair of faces whose boxes meet is tested, in parallel.
bool encloses(const Mesh& outer, const Mesh& inner);

}  // namespace partwise
