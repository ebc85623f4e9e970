#include "partwise/motion/ompl/svma_planner.h"

#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/util/Console.h>

#include "partwise/motion/ompl/ompl_scene.h"

namespace partwise {

namespace ob = ompl::base;

MedialAxisPlanner::MedialAxisPlanner(const ob::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene,
                                     const std::string& name, MakeRetractor make, const AxisPlannerSettings& settings)
    : ob::Planner(si, name), scene_(std::move(scene)), make_(std::move(make)), settings_(settings) {
  using Self = MedialAxisPlanner;
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.multithreaded = true;
  declareParam<int>("batch", this, &Self::set_batch, &Self::batch, "1:100000");
  declareParam<double>("free_share", this, &Self::set_free_share, &Self::free_share, "0.:0.05:1.");
  declareParam<int>("neighbours", this, &Self::set_neighbours, &Self::neighbours, "1:1:50");
  declareParam<double>("clearance_exponent", this, &Self::set_clearance_exponent, &Self::clearance_exponent,
                       "0.:0.25:4.");
  declareParam<unsigned>("seed", this, &Self::set_seed, &Self::seed);
}

MedialAxisPlanner::~MedialAxisPlanner() { free_states(); }

void MedialAxisPlanner::free_states() {
  for (ob::State* each : states_) si_->freeState(each);
  for (const auto& [edge, states] : bends_) {
    for (ob::State* each : states) si_->freeState(each);
  }
  states_.clear();
  bends_.clear();
}

void MedialAxisPlanner::clear() {
  clearQuery();
  free_states();
  planner_.reset();
  retract_.reset();
}

void MedialAxisPlanner::clearQuery() {
  pis_.clear();
  pis_.update();
  starts_.clear();
  goals_.clear();
  known_starts_ = known_goals_ = 0;
  if (planner_) planner_->forget_ends();
}

void MedialAxisPlanner::take_ends() {
  while (const ob::State* start = pis_.nextStart()) {
    starts_.push_back(configuration_of(scene_->space(), start));
    ++known_starts_;
  }
  constexpr int most_goals = 16;  // at once: a region may have any number
  for (int i = 0; i < most_goals; ++i) {
    const ob::State* goal = pis_.nextGoal();
    if (goal == nullptr) break;
    goals_.push_back(configuration_of(scene_->space(), goal));
    ++known_goals_;
  }
}

ob::PlannerStatus MedialAxisPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  checkValidity();
  if (dynamic_cast<ob::GoalSampleableRegion*>(pdef_->getGoal().get()) == nullptr) {
    OMPL_ERROR("%s: goals of this type are not understood; give states or a region to sample", getName().c_str());
    return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  }
  take_ends();
  if (known_starts_ == 0) {
    OMPL_ERROR("%s: no valid start", getName().c_str());
    return ob::PlannerStatus::INVALID_START;
  }
  if (known_goals_ == 0) {
    if (const ob::State* goal = pis_.nextGoal(ptc)) {
      goals_.push_back(configuration_of(scene_->space(), goal));
      ++known_goals_;
    } else {
      OMPL_ERROR("%s: no valid goal", getName().c_str());
      return ob::PlannerStatus::INVALID_GOAL;
    }
  }
  const Progress progress{{}, [&ptc] { return ptc(); }};
  try {
    if (!retract_) retract_ = make_(progress);
    if (!planner_) planner_ = std::make_unique<AxisPlanner>(*scene_, *retract_, settings_);
    while (true) {
      take_ends();
      for (const Configuration& q : std::exchange(starts_, {})) planner_->add_start(q);
      for (const Configuration& q : std::exchange(goals_, {})) planner_->add_goal(q);
      planner_->join_ends(progress);
      if (const std::optional<MotionPath> path = planner_->path(progress)) {
        pdef_->addSolutionPath(geometric_path(si_, scene_->space(), *path), false, 0, getName());
        return ob::PlannerStatus::EXACT_SOLUTION;
      }
      planner_->grow(progress);
    }
  } catch (const Cancelled&) {
    return ob::PlannerStatus::TIMEOUT;
  } catch (const InputError& error) {
    OMPL_ERROR("%s: %s", getName().c_str(), error.what());
    return ob::PlannerStatus::ABORT;
  }
}

const ob::State* MedialAxisPlanner::state_of(int sample) const {
  while (static_cast<int>(states_.size()) <= sample) {
    states_.push_back(si_->allocState());
    write_state(scene_->space(), planner_->roadmap().samples()[states_.size() - 1].q, states_.back());
  }
  return states_[static_cast<std::size_t>(sample)];
}

const std::vector<ob::State*>& MedialAxisPlanner::states_of(const RoadmapEdge& edge) const {
  std::vector<ob::State*>& states = bends_[{edge.from, edge.to}];
  for (std::size_t i = states.size(); i < edge.between.size(); ++i) {
    states.push_back(si_->allocState());
    write_state(scene_->space(), edge.between[i], states.back());
  }
  return states;
}

void MedialAxisPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  if (!planner_) return;
  for (const int start : planner_->starts()) data.addStartVertex(ob::PlannerDataVertex(state_of(start)));
  for (const int goal : planner_->goals()) data.addGoalVertex(ob::PlannerDataVertex(state_of(goal)));
  for (std::size_t i = 0; i < planner_->roadmap().samples().size(); ++i)
    data.addVertex(ob::PlannerDataVertex(state_of(static_cast<int>(i))));
  for (const RoadmapEdge& edge : planner_->roadmap().roadmap().edges) {
    const ob::State* last = state_of(edge.from);
    const auto step = [&](const ob::State* next) {
      data.addEdge(ob::PlannerDataVertex(last), ob::PlannerDataVertex(next));
      data.addEdge(ob::PlannerDataVertex(next), ob::PlannerDataVertex(last));
      last = next;
    };
    for (const ob::State* bend : states_of(edge)) step(bend);
    step(state_of(edge.to));
  }
}

SVMA::SVMA(const ob::SpaceInformationPtr& si, const ProblemScene& problem)
    : MedialAxisPlanner(si, problem.scene, "SVMA",
                        [this, problem](const Progress& progress) { return trained(problem, progress); }) {
  declareParam<double>("epsilon", this, &SVMA::set_epsilon, &SVMA::epsilon, "0.001:0.001:0.1");
  declareParam<int>("most_steps", this, &SVMA::set_most_steps, &SVMA::most_steps, "1:1:200");
  declareParam<double>("density", this, &SVMA::set_density, &SVMA::density, "0.:0.1:2.");
}

std::unique_ptr<Retractor> SVMA::trained(const ProblemScene& problem, const Progress& progress) const {
  MarginFieldSettings field = field_;
  field.seed = settings().seed;
  return trained_push(scene(), problem.contacts(progress), field, push_, progress);
}

}  // namespace partwise
