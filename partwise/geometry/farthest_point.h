// How far a surface strays from something: the largest value of a distance over all points of its faces, certified.
//
// The distance may be any function that changes by at most the length of a step, such as SurfaceQuery::distance or the
// distance outside of a solid. Branch and bound: on a triangle no value exceeds that at its middle by more than its
// radius about it; the triangle with the largest bound is split at its longest side until bound and largest value found
// are within `precision`. The directed Hausdorff distance between surfaces is found so. Deterministic, one thread.
// Errors: InputError for a precision that is not positive; CheckFailed for a mesh without faces.
#pragma once

#include <functional>

#include "partwise/geometry/mesh.h"

namespace partwise {

// An upper bound of the largest value, at most `precision` above a value that was found.
double farthest_point(const Mesh& surface, const std::function<double(const Point&)>& distance, double precision);

}  // namespace partwise
