// Volume, centre of mass and inertia of the solid inside closed triangle meshes, exact up to rounding.
//
// The volume integrals of 1, x, x^2 and x y (Mirtich 1996, *Fast and accurate computation of polyhedral mass
// properties*) as sums over signed tetrahedra from a point near the mesh to each face (Blow, Binstock 2004). Time O(m).
//
// Units: lengths are those of the model, the density is 1: mass is volume. For another density multiply the mass and
// the inertia by it. Faces count as they are turned; a mesh that is inside out as a whole gives the same as its
// reverse. Errors: InputError when the volume is zero, or so small that rounding drowns it (below 1e-12 of the bounding
// box's diagonal cubed).
#pragma once

#include <Eigen/Core>

#include <span>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct MassProperties {
  double volume = 0;                                  // positive; the mass at density 1
  Point centre = Point::Zero();                       // of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, in the axes of the model; symmetric
};

// Of one closed mesh (see is_watertight).
MassProperties mass_properties(const Mesh& mesh);

// Of several bodies together; where they overlap, space counts as often as it is covered. Those without volume are
// left out; InputError when none has volume.
MassProperties mass_properties(std::span<const Mesh> meshes);

// True when a rigid body can have this inertia: principal moments are positive and none exceeds the sum of the others
// (with a slack of 1e-9). Meshes that cross themselves may fail. Physics engines refuse bodies that do.
bool is_physical(const MassProperties& properties);

}  // namespace partwise
