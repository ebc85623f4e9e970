// A rigid robot with a body among obstacles, all of them meshes: in space, SE(3), the plane and SE(2). Distances are
// exact, between the triangles of both (FCL, mesh_proximity.h), with gradients from the two nearest points: the unit
// vector between them, and its moment about the robot's origin.
//
// Bodies are given in the robot's frame. An obstacle is a set of faces of `solid`, whose winding number says what is
// inside (geometry/surface_query.h), so that parts which are not closed by themselves may be obstacles. The robot is in
// collision where triangles meet, where a body lies wholly inside the solid, and where a piece of an obstacle lies
// wholly inside a body; bodies that are not closed have no inside. In the plane, z is what the meshes say.
//
// The rotation scale of the space is the body's radius about its origin, so that displacements bound the motion of all
// its points (configuration_space.h). Time a distance: about log n of the triangles for each body and each obstacle
// whose box is as near as the answer.
//
// Errors: InputError for no bodies or obstacles, or one without a face.
#pragma once

#include <memory>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/motion/scene.h"

namespace partwise {

// The largest distance of a vertex from the robot's origin; in spaces of the plane, from its axis.
double body_radius(SpaceKind kind, const std::vector<Mesh>& robot);

std::unique_ptr<Scene> body_scene(SpaceKind kind, const Eigen::AlignedBox3d& bounds, const std::vector<Mesh>& robot,
                                  const std::vector<Mesh>& obstacles, const Mesh& solid);

}  // namespace partwise
