// A rigid body for Bullet from the convex hulls of a decomposition.
//
// Bullet wants a body's shape about its centre of mass with the principal axes of inertia as its own axes, so the hulls
// are moved and turned there; `model` brings points of the model along. Mass and inertia are those of the solid hulls:
// where hulls overlap, space weighs twice.
// Units: lengths are multiplied by `scale`. Bullet is at ease with bodies of 0.1 to 10 m; at that size the collision
// margin, by which every hull grows, is half a per cent of the size and better than the default of 4 cm.
// Errors: InputError for no hulls, or none with a volume.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

struct Compound {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  std::unique_ptr<btCompoundShape> shape;
  btScalar mass = 0;                               // kg
  btVector3 inertia = btVector3(0, 0, 0);          // principal moments, kg m^2
  btScalar scale = 1;                              // metres in a unit of the model
  btTransform model = btTransform::getIdentity();  // from the scaled model to the body
  btScalar margin = 0;                             // metres

  // Where a point of the model is when the body's transform is `pose`.
  btVector3 world(const btTransform& pose, const partwise::Point& point) const;
};

Compound make_compound(std::span<const partwise::Mesh> hulls, double scale = 1, double density = 1000);

// A body of the compound's shape, mass and inertia, to be added to a world. The compound must outlive it.
std::unique_ptr<btRigidBody> make_body(const Compound& compound, const btTransform& pose);
