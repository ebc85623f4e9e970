// Valid states on the medial axis for any planner of OMPL that draws from a ValidStateSampler, PRM for example: states
// drawn by the space's own sampler are pushed along a max-margin field (margin_push.h), and kept where they arrive
// free, within the bounds, and on the axis (medial_axis.h).
//
//   si->setValidStateSamplerAllocator(svma_sampler_allocator(scene, push));
//
// sampleNear() pushes states drawn near and keeps those that stay within the distance.
#pragma once

#include <ompl/base/StateSampler.h>
#include <ompl/base/ValidStateSampler.h>

#include <memory>

#include "partwise/motion/medial_axis.h"

namespace partwise {

class SvmaValidStateSampler final : public ompl::base::ValidStateSampler {
 public:
  // `push`, of the same scene, as trained_push() makes it (margin_push.h); any other retractor does as well.
  SvmaValidStateSampler(const ompl::base::SpaceInformation* si, std::shared_ptr<const Scene> scene,
                        std::shared_ptr<const Retractor> push);

  bool sample(ompl::base::State* state) override;
  bool sampleNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;

 private:
  bool pushed(ompl::base::State* state);

  ompl::base::StateSamplerPtr sampler_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const Retractor> push_;
  std::uint64_t drawn_ = 0;
};

ompl::base::ValidStateSamplerAllocator svma_sampler_allocator(std::shared_ptr<const Scene> scene,
                                                              std::shared_ptr<const Retractor> push);

}  // namespace partwise
