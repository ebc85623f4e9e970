#include "compound.h"

#include <Eigen/Eigenvalues>

#include "partwise/geometry/mass.h"

namespace {

btVector3 bullet(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

}  // namespace

btVector3 Compound::world(const btTransform& pose, const partwise::Point& point) const {
  return pose * (model * (scale * bullet(point.transpose())));
}

Compound make_compound(std::span<const partwise::Mesh> hulls, double scale, double density) {
  const partwise::MassProperties solid = partwise::mass_properties(hulls);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(solid.inertia);
  Eigen::Matrix3d axes = principal.eigenvectors();  // columns
  if (axes.determinant() < 0) axes.col(2) *= -1;    // a rotation, no reflection

  Compound compound;
  compound.scale = static_cast<btScalar>(scale);
  compound.mass = static_cast<btScalar>(density * scale * scale * scale * solid.volume);
  compound.inertia = bullet(principal.eigenvalues() * (density * std::pow(scale, 5)));
  const Eigen::Matrix3d turn = axes.transpose();
  compound.model.setBasis(
      {static_cast<btScalar>(turn(0, 0)), static_cast<btScalar>(turn(0, 1)), static_cast<btScalar>(turn(0, 2)),
       static_cast<btScalar>(turn(1, 0)), static_cast<btScalar>(turn(1, 1)), static_cast<btScalar>(turn(1, 2)),
       static_cast<btScalar>(turn(2, 0)), static_cast<btScalar>(turn(2, 1)), static_cast<btScalar>(turn(2, 2))});
  compound.model.setOrigin(bullet(-scale * turn * solid.centre.transpose()));
  partwise::Point low = hulls[0].vertices.row(0), high = low;
  for (const partwise::Mesh& hull : hulls) {
    low = low.cwiseMin(hull.vertices.colwise().minCoeff());
    high = high.cwiseMax(hull.vertices.colwise().maxCoeff());
  }
  compound.margin = static_cast<btScalar>(0.0025 * scale * (high - low).norm());

  compound.shape = std::make_unique<btCompoundShape>(true, static_cast<int>(hulls.size()));
  for (const partwise::Mesh& hull : hulls) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (Eigen::Index i = 0; i < hull.vertices.rows(); ++i) {
      shape->addPoint(compound.model * (compound.scale * bullet(hull.vertices.row(i).transpose())), false);
    }
    shape->setMargin(compound.margin);
    shape->recalcLocalAabb();
    compound.shape->addChildShape(btTransform::getIdentity(), shape.get());
    compound.hulls.push_back(std::move(shape));
  }
  return compound;
}

std::unique_ptr<btRigidBody> make_body(const Compound& compound, const btTransform& pose) {
  btRigidBody::btRigidBodyConstructionInfo info(compound.mass, nullptr, compound.shape.get(), compound.inertia);
  info.m_startWorldTransform = pose;
  info.m_friction = 0.7f;
  info.m_rollingFriction = 0.05f;  // or a cup would roll for ever on an ideal plane
  info.m_spinningFriction = 0.05f;
  info.m_linearDamping = 0.02f;
  info.m_angularDamping = 0.05f;
  return std::make_unique<btRigidBody>(info);
}
