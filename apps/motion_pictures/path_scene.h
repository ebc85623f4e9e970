// The robot along its path among the obstacles, for people.
#pragma once

#include <vector>

#include "partwise/geometry/mesh_io.h"
#include "partwise/motion/motion_path.h"
#include "partwise/motion/planning_problem.h"

namespace partwise {

// Obstacles grey; the robot at places evenly along the path, from dark blue at the start to yellow at the goal, and the
// way of its origin as a thin tube. Footprints stand a hundredth of the bounds high.
std::vector<NamedMesh> path_scene(const PlanningProblem& problem, const ConfigurationSpace& space,
                                  const MotionPath& found);

}  // namespace partwise
