// Prisms: polygons of the plane swept along z.
//
// The polygon must be valid (polygon.h). Its corners appear at z = low and at z = high, n and n of them, in the order
// of its rings; corners that coincide, where rings touch, become one. The caps are Delaunay triangulations
// (constrained_delaunay.h), the sides two triangles each. The surface is closed and looks outward. low < high.
#pragma once

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

Mesh prism(const Polygon& polygon, double low, double high);

}  // namespace partwise
