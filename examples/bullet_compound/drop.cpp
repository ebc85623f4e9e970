#include "drop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world.h"

namespace {

double lowest_point(const Compound& compound, std::span<const partwise::Mesh> hulls, const btTransform& pose) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const partwise::Mesh& hull : hulls) {
    for (Eigen::Index i = 0; i < hull.vertices.rows(); ++i) {
      lowest = std::min<double>(lowest, compound.world(pose, hull.vertices.row(i)).y());
    }
  }
  return lowest;
}

}  // namespace

Drop drop(const Compound& compound, std::span<const partwise::Mesh> hulls, const DropSettings& settings) {
  constexpr int steps_a_second = 240;
  btTransform start = compound.model.inverse();  // the model's axes as they are, its origin at the world's
  const btQuaternion tilt(btVector3(1, 0, 1).normalized(), static_cast<btScalar>(settings.tilt));
  start = btTransform(tilt) * start;
  start.getOrigin().setY(start.getOrigin().y() +
                         static_cast<btScalar>(settings.height - lowest_point(compound, hulls, start)));

  World world;
  btRigidBody& body = world.add(make_body(compound, start));
  body.setActivationState(DISABLE_DEACTIVATION);  // rest has to come from the contacts, not from falling asleep
  Drop result;
  int still_steps = 0;
  int steps = 0;
  btVector3 up;
  while (still_steps < steps_a_second && steps < settings.longest * steps_a_second) {
    world.step(btScalar(1) / steps_a_second);
    ++steps;
    const bool still = body.getLinearVelocity().length() < settings.still_speed &&
                       body.getAngularVelocity().length() < settings.still_turning;
    const btVector3 up_now = body.getWorldTransform().getBasis().getColumn(1);
    if (!still || still_steps == 0) up = up_now, result.last_wobble = 0;
    result.last_wobble = std::max<double>(result.last_wobble, std::asin(std::min(1.0f, up.cross(up_now).length())));
    still_steps = still ? still_steps + 1 : 0;
  }
  result.rested = still_steps == steps_a_second;
  result.seconds = static_cast<double>(steps - still_steps) / steps_a_second;
  result.pose = body.getWorldTransform();
  result.lowest = lowest_point(compound, hulls, result.pose);
  return result;
}
