// Meshes that are convex already: the hull is the solid, and there is nothing to cut nor to measure. (To the octree of
// outside_distance.h a hull that lies on the surface everywhere is the dearest of all.)
#pragma once

#include <optional>

#include "partwise/geometry/mesh.h"

namespace partwise {

// The hull of a closed, connected mesh with no vertex above the plane of any of its faces, but for 1e-12 of its
// radius; vertices of no face do not count. Nothing for other meshes, for ones that are thinner than
// `minimum_thickness` (of the radius), and for ones with so many faces that looking takes longer than it saves.
// `bounds`: the bounding sphere.
std::optional<Mesh> convex_solid(const Mesh& mesh, const Sphere& bounds, double minimum_thickness);

}  // namespace partwise
