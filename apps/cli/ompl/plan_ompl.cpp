#include "plan_ompl.h"

#include <filesystem>
#include <sstream>

#include "partwise/motion/ompl/planners.h"

namespace partwise::cli {
namespace {

PlannerChoice choice(const PlannerByName& planner) { return {planner.planner, planner.sampler, planner.seed}; }

}  // namespace

std::optional<MotionPath> path_by_ompl(const ProblemScene& problem, const MotionQuery& query,
                                       const PlannerByName& planner, double seconds, const Progress& progress) {
  return planned(problem, query, choice(planner), seconds, progress);
}

LoggedRuns logged_runs(const std::string& name, const ProblemScene& problem, const MotionQuery& query,
                       const PlannerByName& planner, double seconds, int runs, const Progress& progress) {
  std::ostringstream log;
  const std::string stem = std::filesystem::path(name).stem().string();
  LoggedRuns result;
  for (const BenchmarkRun& run : benchmark(stem, problem, query, choice(planner), seconds, runs, log, progress)) {
    if (!run.solved) continue;
    if (!result.path) result.path = run.path;
    result.seconds += run.seconds;
    ++result.solved;
  }
  if (result.solved > 0) result.seconds /= result.solved;
  result.log = log.str();
  return result;
}

}  // namespace partwise::cli
