#include "partwise/motion/free_motion.h"

#include <algorithm>

namespace partwise {

double clearance(const Scene& scene, const Configuration& q) {
  const double room = scene.room(q);
  return room > 0 && scene.free(q) ? std::min(room, scene.nearest(q, 1).front().distance) : 0;
}

MotionCheck free_motion(const Scene& scene, const Configuration& a, double clearance_a, const Configuration& b,
                        double clearance_b, double resolution) {
  const double length = scene.space().displacement(a, b);
  if (clearance_a <= 0 || clearance_b <= 0) return {};
  if (length < clearance_a + clearance_b) return {true};
  if (length < resolution) return {};
  const Configuration middle = scene.space().between(a, b, 0.5);
  const double clearance_middle = clearance(scene, middle);
  MotionCheck first = free_motion(scene, a, clearance_a, middle, clearance_middle, resolution);
  ++first.distance_queries;
  if (!first.free) return first;
  const MotionCheck second = free_motion(scene, middle, clearance_middle, b, clearance_b, resolution);
  return {second.free, first.distance_queries + second.distance_queries};
}

}  // namespace partwise
