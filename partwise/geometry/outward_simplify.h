// A closed surface with fewer faces that encloses the given one, after progressive hulls (Sander, Gu, Gortler, Hoppe,
// Snyder 2000, section 3.2), for surfaces that need not be convex.
//
// Edges are collapsed, cheapest first. The new vertex lies outside the planes of all faces that go, so that old and new
// faces bound tetrahedra of positive volume: the winding number grows nowhere below what it was. A collapse is refused
// where a new face would cross another, or turn over. Hence for a closed manifold that does not cross itself the result
// is one too, of the same genus, and what was inside stays inside. Where the vertex is best placed, two answers
// compete: the least volume by a linear programme, and the least squared distance from the planes (Garland, Heckbert
// 1997), pushed out. The cost is the volume added, plus a little for length.
//
// The result has at most max_faces faces unless no more edge can be collapsed; the caller looks. Deterministic, one
// thread; O(n log n) collapses, each compared with the boxes of all faces.
// Errors: CheckFailed for a mesh that is not closed or has edges of more than two faces.
#pragma once

#include "partwise/geometry/mesh.h"

namespace partwise {

Mesh simplify_outwards(const Mesh& surface, int max_faces);

}  // namespace partwise
