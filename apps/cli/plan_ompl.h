// What `partwise plan` takes from OMPL: its PRM, and benchmarks of all planners in its own log. Where the program was
// built without OMPL these say so, by an InputError.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "partwise/base/progress.h"
#include "partwise/motion/motion_path.h"
#include "partwise/motion/planning_problem.h"
#include "partwise/motion/world.h"

namespace partwise::cli {

struct PlannerByName {
  std::string planner = "svma", sampler = "uniform";
  std::uint64_t seed = 0;
};

// Nothing when the time is over.
std::optional<MotionPath> path_by_ompl(const ProblemScene& problem, const MotionQuery& query,
                                       const PlannerByName& planner, double seconds, const Progress& progress);

struct LoggedRuns {
  std::string log;
  std::optional<MotionPath> path;  // of the first run that found one
  double seconds = 0;              // in the mean of those
  int solved = 0;
};

LoggedRuns logged_runs(const std::string& name, const ProblemScene& problem, const MotionQuery& query,
                       const PlannerByName& planner, double seconds, int runs, const Progress& progress);

}  // namespace partwise::cli
