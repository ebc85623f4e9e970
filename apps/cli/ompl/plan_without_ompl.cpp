#include "partwise/base/error.h"
#include "plan_ompl.h"

namespace partwise::cli {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(what, "needs OMPL, and this program was built without it",
                   "install libompl-dev and libboost-filesystem-dev, and build it again");
}

}  // namespace

std::optional<MotionPath> path_by_ompl(const ProblemScene& /*problem*/, const MotionQuery& /*query*/,
                                       const PlannerByName& /*planner*/, double /*seconds*/,
                                       const Progress& /*progress*/) {
  refuse("--planner prm");
}

LoggedRuns logged_runs(const std::string& /*name*/, const ProblemScene& /*problem*/, const MotionQuery& /*query*/,
                       const PlannerByName& /*planner*/, double /*seconds*/, int /*runs*/,
                       const Progress& /*progress*/) {
  refuse("--log");
}

}  // namespace partwise::cli
