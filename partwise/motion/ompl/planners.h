// Planners of OMPL by name, on the same scene, validity and motion checks, so that they can be compared fairly, and
// their benchmark: OMPL's own log, which ompl_benchmark_statistics.py and Planner Arena read, with what paths keep of
// clearance beside OMPL's properties.
//
//   svma, maprm, umaprm   svma_planner.h
//   prm                   OMPL's PRM, on states drawn evenly (uniform), by the bridge test (bridge), near obstacles
//                         (obstacle), as the best of some draws (clearance), or on the axis (svma)
//
// Properties of a solved run, all measured along the whole path (motion_path.h), lengths as displacements:
//   path length, path minimum clearance, path mean clearance   as it was found
//   kept length, kept minimum clearance                        simplified here (path_simplify.h)
//   shortcut length, shortcut minimum clearance                simplified by OMPL's shortcuts
//
// OMPL draws anew for each run; its PRM runs in two threads, and its results are not the same twice. Errors: InputError
// for starts or goals that are not free, CheckFailed for names that are not of the list.
#pragma once

#include <ompl/base/Planner.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/motion/motion_path.h"
#include "partwise/motion/planning_problem.h"
#include "partwise/motion/world.h"

namespace partwise {

struct PlannerChoice {
  std::string planner = "svma";
  std::string sampler = "uniform";  // of prm
  std::uint64_t seed = 0;
};

ompl::base::PlannerPtr named_planner(const ompl::base::SpaceInformationPtr& si, const ProblemScene& problem,
                                     const PlannerChoice& choice);

// By one planner, or nothing when the time is over. Errors: Cancelled.
std::optional<MotionPath> planned(const ProblemScene& problem, const MotionQuery& query, const PlannerChoice& choice,
                                  double seconds, const Progress& progress = {});

struct BenchmarkRun {
  bool solved = false;
  double seconds = 0;
  MotionPath path;  // as it was found
  PathClearance clearance;
};

// All runs, and the log.
std::vector<BenchmarkRun> benchmark(const std::string& name, const ProblemScene& problem, const MotionQuery& query,
                                    const PlannerChoice& choice, double seconds, int runs, std::ostream& log,
                                    const Progress& progress = {});

}  // namespace partwise
