// The smallest clearance along a path as an objective of OMPL, the larger the better. Unlike OMPL's own
// MaximizeMinClearanceObjective it measures motions all along (motion_path.h), not at states every so often.
#pragma once

#include <ompl/base/objectives/MinimaxObjective.h>

#include <memory>

#include "partwise/motion/scene.h"

namespace partwise {

class MinimumClearanceObjective final : public ompl::base::MinimaxObjective {
 public:
  MinimumClearanceObjective(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene);

  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  ompl::base::Cost motionCost(const ompl::base::State* from, const ompl::base::State* to) const override;
  bool isCostBetterThan(ompl::base::Cost a, ompl::base::Cost b) const override;
  ompl::base::Cost identityCost() const override;
  ompl::base::Cost infiniteCost() const override;

 private:
  std::shared_ptr<const Scene> scene_;
};

}  // namespace partwise
