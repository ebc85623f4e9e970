// A convex hull with few vertices that still encloses the given one, as progressive hulls do (Sander, Gu, Gortler,
// Hoppe, Snyder 2000, section 3.2): edges are collapsed, each to the point outside all planes of the incident faces that
// adds the least volume (a linear programme in three unknowns), cheapest first, and the convex hull of what remains is
// taken.
//
// Promise: every vertex of `hull` lies inside the result by the planes of the result, to 1e-12 of the hull's size; the
// result has at most `max_vertices` vertices (at least 4; a tetrahedron always encloses). A hull with few enough
// vertices is returned as it is.
// Errors: InputError for max_vertices < 4.
#pragma once

#include "partwise/geometry/mesh.h"

namespace partwise {

Mesh simplify_hull(const Mesh& hull, int max_vertices);

}  // namespace partwise
