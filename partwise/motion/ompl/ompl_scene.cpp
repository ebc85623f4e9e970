#include "partwise/motion/ompl/ompl_scene.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <utility>

#include "partwise/motion/free_motion.h"

namespace partwise {
namespace {

namespace ob = ompl::base;

ob::RealVectorBounds bounds_of(const ConfigurationSpace& space) {
  const auto axes = static_cast<unsigned>(position_axes(space.kind()));
  ob::RealVectorBounds bounds(axes);
  for (unsigned i = 0; i < axes; ++i) {
    bounds.setLow(i, space.bounds().min()[i]);
    bounds.setHigh(i, space.bounds().max()[i]);
  }
  return bounds;
}

template <typename Space>
std::shared_ptr<Space> turning_space(const ConfigurationSpace& space, double weight) {
  auto result = std::make_shared<Space>();
  result->setBounds(bounds_of(space));
  result->setSubspaceWeight(1, weight);
  return result;
}

class SceneValidity final : public ob::StateValidityChecker {
 public:
  SceneValidity(const ob::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene)
      : ob::StateValidityChecker(si), scene_(std::move(scene)) {
    specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::EXACT;
  }

  bool isValid(const ob::State* state) const override {
    const Configuration q = configuration_of(scene_->space(), state);
    return scene_->within_bounds(q) && scene_->free(q);
  }
  double clearance(const ob::State* state) const override {
    const Configuration q = configuration_of(scene_->space(), state);
    return scene_->free(q) ? scene_->nearest(q, 1).front().distance : 0;
  }

 private:
  std::shared_ptr<const Scene> scene_;
};

class CertifiedMotion final : public ob::MotionValidator {
 public:
  CertifiedMotion(const ob::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene)
      : ob::MotionValidator(si),
        scene_(std::move(scene)),
        resolution_(1e-5 * scene_->space().bounds().diagonal().norm()) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const Configuration a = configuration_of(scene_->space(), from), b = configuration_of(scene_->space(), to);
    const bool free = free_motion(*scene_, a, clearance(*scene_, a), b, clearance(*scene_, b), resolution_).free;
    ++(free ? valid_ : invalid_);
    return free;
  }

  // The last valid state by halving: of what is left, always the first half that is not free.
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(from, to)) return true;
    constexpr int halvings = 12;
    const Configuration a = configuration_of(scene_->space(), from), b = configuration_of(scene_->space(), to);
    const double clearance_a = clearance(*scene_, a);
    double low = 0, high = 1;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (low + high) / 2;
      const Configuration q = scene_->space().between(a, b, middle);
      const bool free = free_motion(*scene_, a, clearance_a, q, clearance(*scene_, q), resolution_).free;
      (free ? low : high) = middle;
    }
    last_valid.second = low;
    if (last_valid.first != nullptr) write_state(scene_->space(), scene_->space().between(a, b, low), last_valid.first);
    return false;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  double resolution_;
};

}  // namespace

ob::StateSpacePtr state_space(const ConfigurationSpace& space) {
  // OMPL's distance of two rotations of space is half the angle between them.
  if (space.kind() == SpaceKind::se3) return turning_space<ob::SE3StateSpace>(space, 2 * space.rotation_scale());
  if (space.kind() == SpaceKind::se2) return turning_space<ob::SE2StateSpace>(space, space.rotation_scale());
  auto flat = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(position_axes(space.kind())));
  flat->setBounds(bounds_of(space));
  return flat;
}

Configuration configuration_of(const ConfigurationSpace& space, const ob::State* state) {
  Configuration q(space.coordinates());
  if (space.kind() == SpaceKind::se2) {
    const auto* at = state->as<ob::SE2StateSpace::StateType>();
    q << at->getX(), at->getY(), wrapped_angle(at->getYaw());
  } else if (space.kind() == SpaceKind::se3) {
    const auto* at = state->as<ob::SE3StateSpace::StateType>();
    const auto& turn = at->rotation();
    q.head(3) << at->getX(), at->getY(), at->getZ();
    q.tail<4>() = quaternion_coordinates({turn.w, turn.x, turn.y, turn.z});
  } else {
    const auto* at = state->as<ob::RealVectorStateSpace::StateType>();
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = at->values[i];
  }
  return q;
}

void write_state(const ConfigurationSpace& space, const Configuration& q, ob::State* state) {
  if (space.kind() == SpaceKind::se2) {
    auto* at = state->as<ob::SE2StateSpace::StateType>();
    at->setXY(q[0], q[1]);
    at->setYaw(q[2]);
  } else if (space.kind() == SpaceKind::se3) {
    auto* at = state->as<ob::SE3StateSpace::StateType>();
    at->setXYZ(q[0], q[1], q[2]);
    at->rotation().w = q[3];
    at->rotation().x = q[4];
    at->rotation().y = q[5];
    at->rotation().z = q[6];
  } else {
    auto* at = state->as<ob::RealVectorStateSpace::StateType>();
    for (Eigen::Index i = 0; i < q.size(); ++i) at->values[i] = q[i];
  }
}

ob::SpaceInformationPtr space_information(std::shared_ptr<const Scene> scene) {
  auto si = std::make_shared<ob::SpaceInformation>(state_space(scene->space()));
  si->setStateValidityChecker(std::make_shared<SceneValidity>(si, scene));
  si->setMotionValidator(std::make_shared<CertifiedMotion>(si, std::move(scene)));
  si->setup();
  return si;
}

std::shared_ptr<ompl::geometric::PathGeometric> geometric_path(const ob::SpaceInformationPtr& si,
                                                               const ConfigurationSpace& space,
                                                               const MotionPath& path) {
  auto result = std::make_shared<ompl::geometric::PathGeometric>(si);
  for (const Configuration& q : path.configurations) {
    ob::State* state = si->allocState();
    write_state(space, q, state);
    result->getStates().push_back(state);  // which owns it
  }
  return result;
}

MotionPath motion_path(const ConfigurationSpace& space, const ompl::geometric::PathGeometric& path) {
  MotionPath result;
  for (std::size_t i = 0; i < path.getStateCount(); ++i)
    result.configurations.push_back(configuration_of(space, path.getState(static_cast<unsigned>(i))));
  return result;
}

void simplify(ompl::geometric::PathGeometric& path, const Scene& scene, const PathSimplifySettings& settings) {
  path = *geometric_path(path.getSpaceInformation(), scene.space(),
                         simplified(scene, motion_path(scene.space(), path), settings));
}

}  // namespace partwise
