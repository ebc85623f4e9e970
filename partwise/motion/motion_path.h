// A path of a robot: configurations, with straight motions between them (geodesics of its space), how long it is, and
// how far it keeps from obstacles. Lengths are displacements (configuration_space.h): of a robot that does not turn the
// usual ones, else the way plus the turns, a radian counting as the body's radius.
//
// Clearance is the distance from the nearest obstacle, 0 where the robot is not free. It changes by no more than the
// displacement, so its minimum along a path is found by halving motions where it may still be smaller, not by sampling.
#pragma once

#include <vector>

#include "partwise/motion/scene.h"

namespace partwise {

struct MotionPath {
  std::vector<Configuration> configurations;  // one at least
};

double path_length(const ConfigurationSpace& space, const MotionPath& path);

// The configuration at a share of the length, in [0, 1].
Configuration path_at(const ConfigurationSpace& space, const MotionPath& path, double share);

struct PathClearance {
  double minimum = 0;  // at most 1 % above the smallest, never below it
  double mean = 0;     // along the length, by trapezoids no longer than a tenth of the clearance at their ends
};

PathClearance path_clearance(const Scene& scene, const MotionPath& path);

}  // namespace partwise
