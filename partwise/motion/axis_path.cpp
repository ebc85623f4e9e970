#include "partwise/motion/axis_path.h"

#include <chrono>
#include <memory>

#include "partwise/motion/axis_planner.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/umaprm.h"

namespace partwise {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool stopped(const Progress& progress) { return progress.cancelled && progress.cancelled(); }

// Until the time is over. `progress` must outlive it.
Progress limited(const Progress& progress, double seconds) {
  return {progress.report,
          [&progress, start = Clock::now(), seconds] { return seconds_since(start) > seconds || stopped(progress); }};
}

std::unique_ptr<Retractor> retractor(const ProblemScene& problem, const AxisPathSettings& settings,
                                     const Progress& progress) {
  if (settings.method == AxisMethod::maprm) return std::make_unique<Maprm>(*problem.scene);
  if (settings.method == AxisMethod::umaprm) return std::make_unique<Umaprm>(*problem.scene);
  const MarginFieldSettings field{.seed = settings.seed};
  return trained_push(*problem.scene, problem.contacts(progress), field, {}, progress);
}

AxisPlannerSettings planner_settings(const AxisPathSettings& settings) {
  AxisPlannerSettings result;
  result.only_on_axis = settings.method != AxisMethod::maprm;
  result.connecting.push = settings.method == AxisMethod::svma;
  result.seed = settings.seed;
  return result;
}

}  // namespace

std::optional<AxisPath> axis_path(const ProblemScene& problem, const MotionQuery& query,
                                  const AxisPathSettings& settings, const Progress& progress) {
  const Progress in_time = limited(progress, settings.seconds);
  AxisPath found;
  try {
    const auto start = Clock::now();
    const std::unique_ptr<Retractor> retract = retractor(problem, settings, in_time);
    found.seconds["train"] = seconds_since(start);
    const auto trained = Clock::now();
    AxisPlanner planner(*problem.scene, *retract, planner_settings(settings));
    planner.add_start(query.start);
    planner.add_goal(query.goal);
    found.path = planner.solve(in_time);
    found.seconds["search"] = seconds_since(trained);
    found.samples = static_cast<int>(planner.roadmap().samples().size());
    found.edges = static_cast<int>(planner.roadmap().roadmap().edges.size());
    return found;
  } catch (const Cancelled&) {
    if (stopped(progress)) throw;
    return std::nullopt;
  }
}

}  // namespace partwise
