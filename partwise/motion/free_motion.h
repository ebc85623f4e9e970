// Whether a robot may go straight from one configuration to another, decided by distances alone: around a free
// configuration of clearance c, all configurations of a displacement below c are free (configuration_space.h) and
// within the bounds. So a motion is halved until such balls cover it: no sampling, nothing between two checks.
//
// Contact within `resolution` cannot be told from collision and counts as such. With a `margin` the robot also stays
// that far from all obstacles, by the same certificate on distances less the margin.
#pragma once

#include <limits>

#include "partwise/motion/scene.h"

namespace partwise {

// The robot's distance from the nearest obstacle, less the margin, or its room within the bounds if that is less; 0
// where it is not free, outside, or nearer than the margin.
double clearance(const Scene& scene, const Configuration& q, double margin = 0);

struct MotionCheck {
  bool free = false;
  int distance_queries = 0;
  double least = std::numeric_limits<double>::infinity();  // clearance where it was asked for, between the ends
};

// The clearances at both ends are known, less the margin. `resolution` is a displacement, positive.
MotionCheck free_motion(const Scene& scene, const Configuration& a, double clearance_a, const Configuration& b,
                        double clearance_b, double resolution, double margin = 0);

}  // namespace partwise
