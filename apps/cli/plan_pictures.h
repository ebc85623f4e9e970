// What `partwise plan` found, for people: the robot along its path among the obstacles.
#pragma once

#include <filesystem>

#include "partwise/motion/motion_path.h"
#include "partwise/motion/planning_problem.h"

namespace partwise::cli {

// Obstacles grey; the robot at places evenly along the path, from dark blue at the start to yellow at the goal, and the
// way of its origin as a thin tube. Footprints stand a hundredth of the bounds high.
void write_path_glb(const std::filesystem::path& path, const PlanningProblem& problem, const ConfigurationSpace& space,
                    const MotionPath& found);

}  // namespace partwise::cli
