#include "partwise/motion/ompl/clearance_objective.h"

#include <limits>
#include <utility>

#include "partwise/motion/ompl/ompl_scene.h"

namespace partwise {

namespace ob = ompl::base;

MinimumClearanceObjective::MinimumClearanceObjective(const ob::SpaceInformationPtr& si,
                                                     std::shared_ptr<const Scene> scene)
    : ob::MinimaxObjective(si), scene_(std::move(scene)) {
  description_ = "Minimum clearance";
}

ob::Cost MinimumClearanceObjective::stateCost(const ob::State* state) const {
  return ob::Cost(path_clearance(*scene_, {{configuration_of(scene_->space(), state)}}).minimum);
}

ob::Cost MinimumClearanceObjective::motionCost(const ob::State* from, const ob::State* to) const {
  const MotionPath motion{{configuration_of(scene_->space(), from), configuration_of(scene_->space(), to)}};
  return ob::Cost(path_clearance(*scene_, motion).minimum);
}

bool MinimumClearanceObjective::isCostBetterThan(ob::Cost a, ob::Cost b) const { return a.value() > b.value(); }

ob::Cost MinimumClearanceObjective::identityCost() const { return ob::Cost(std::numeric_limits<double>::infinity()); }
ob::Cost MinimumClearanceObjective::infiniteCost() const { return ob::Cost(-std::numeric_limits<double>::infinity()); }

}  // namespace partwise
