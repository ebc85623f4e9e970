// A path of a problem's robot along the medial axis of the free space: what retracts to the axis, trained where it has
// to be, and a roadmap that grows until it joins start and goal (axis_planner.h).
//
//   svma    pushed along a max-margin field, trained here from the problem's contact samples (margin_push.h)
//   maprm   medial-axis PRM with rays (maprm.h)
//   umaprm  where segments cross the axis (umaprm.h)
//
// The peers join samples straight, as they were published. The path is as it was found; path_simplify.h shortens it.
// The same path for the same seed and any number of threads, if the time does not end the search. Errors: InputError
// "scene" for obstacles that have no field, CheckFailed for starts and goals that are not free, Cancelled.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "partwise/base/progress.h"
#include "partwise/motion/motion_path.h"
#include "partwise/motion/planning_problem.h"
#include "partwise/motion/world.h"

namespace partwise {

enum class AxisMethod { svma, maprm, umaprm };

struct AxisPathSettings {
  AxisMethod method = AxisMethod::svma;
  double seconds = 60;  // after which to give up, training included
  std::uint64_t seed = 0;
};

struct AxisPath {
  MotionPath path;
  int samples = 0, edges = 0;             // of the roadmap
  std::map<std::string, double> seconds;  // wall time by stage: train, search
};

// Nothing when the time is over.
std::optional<AxisPath> axis_path(const ProblemScene& problem, const MotionQuery& query,
                                  const AxisPathSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
