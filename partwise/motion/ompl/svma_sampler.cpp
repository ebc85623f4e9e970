#include "partwise/motion/ompl/svma_sampler.h"

#include <ompl/base/SpaceInformation.h>

#include <utility>

#include "partwise/motion/ompl/ompl_scene.h"

namespace partwise {

namespace ob = ompl::base;

SvmaValidStateSampler::SvmaValidStateSampler(const ob::SpaceInformation* si, std::shared_ptr<const Scene> scene,
                                             std::shared_ptr<const Retractor> push)
    : ob::ValidStateSampler(si), sampler_(si->allocStateSampler()), scene_(std::move(scene)), push_(std::move(push)) {
  name_ = "svma";
}

bool SvmaValidStateSampler::pushed(ob::State* state) {
  constexpr std::uint64_t sampler_purpose = 6;
  Draw draw(0, drawn_++, sampler_purpose);
  const Retraction walk = (*push_)(configuration_of(scene_->space(), state), draw);
  if (!walk.done || !scene_->within_bounds(walk.q) || !axis_state(*scene_, walk.q).on_axis()) return false;
  write_state(scene_->space(), walk.q, state);
  return true;
}

bool SvmaValidStateSampler::sample(ob::State* state) {
  for (unsigned i = 0; i < attempts_; ++i) {
    sampler_->sampleUniform(state);
    if (pushed(state)) return true;
  }
  return false;
}

bool SvmaValidStateSampler::sampleNear(ob::State* state, const ob::State* near, double distance) {
  for (unsigned i = 0; i < attempts_; ++i) {
    sampler_->sampleUniformNear(state, near, distance);
    if (pushed(state) && si_->distance(state, near) <= distance) return true;
  }
  return false;
}

ob::ValidStateSamplerAllocator svma_sampler_allocator(std::shared_ptr<const Scene> scene,
                                                      std::shared_ptr<const Retractor> push) {
  return [scene = std::move(scene), push = std::move(push)](const ob::SpaceInformation* si) {
    return std::make_shared<SvmaValidStateSampler>(si, scene, push);
  };
}

}  // namespace partwise
