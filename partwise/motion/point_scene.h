// A point among obstacles of the plane or of space. Distances are exact, by closest points on the obstacles'
// boundaries.
//
// In the plane an obstacle is one or more valid polygons (geometry/polygon.h); their corners and sides belong to them.
// In space an obstacle is a set of faces of `solid`, whose winding number says what is inside
// (geometry/surface_query.h), so that parts which are not closed by themselves may be obstacles. Errors: InputError for
// no obstacles, or one without a face.
#pragma once

#include <memory>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/motion/scene.h"

namespace partwise {

std::unique_ptr<Scene> point_scene(const std::vector<Polygons>& obstacles, const Eigen::AlignedBox2d& bounds);
std::unique_ptr<Scene> point_scene(const std::vector<Mesh>& obstacles, const Mesh& solid,
                                   const Eigen::AlignedBox3d& bounds);

}  // namespace partwise
