#include "partwise/motion/free_motion.h"

#include <algorithm>

namespace partwise {

double clearance(const Scene& scene, const Configuration& q, double margin) {
  const double room = scene.room(q);
  if (room <= 0 || !scene.free(q)) return 0;
  return std::max(0.0, std::min(room, scene.nearest(q, 1).front().distance - margin));
}

MotionCheck free_motion(const Scene& scene, const Configuration& a, double clearance_a, const Configuration& b,
                        double clearance_b, double resolution, double margin) {
  const double length = scene.space().displacement(a, b);
  if (clearance_a <= 0 || clearance_b <= 0) return {};
  if (length < clearance_a + clearance_b) return {true};
  if (length < resolution) return {};
  const Configuration middle = scene.space().between(a, b, 0.5);
  const double clearance_middle = clearance(scene, middle, margin);
  MotionCheck check = free_motion(scene, a, clearance_a, middle, clearance_middle, resolution, margin);
  ++check.distance_queries;
  check.least = std::min(check.least, clearance_middle);
  if (!check.free) return check;
  const MotionCheck second = free_motion(scene, middle, clearance_middle, b, clearance_b, resolution, margin);
  return {second.free, check.distance_queries + second.distance_queries, std::min(check.least, second.least)};
}

}  // namespace partwise
