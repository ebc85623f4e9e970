// Planners of OMPL that go along the medial axis (axis_planner.h).
//
// SVMA trains its field when it first solves, which is part of the time that solve() takes, and obeys termination
// conditions meanwhile; a training that was stopped starts anew. clear() forgets everything, the field too;
// clearQuery() keeps field and roadmap for other starts and goals. Several starts and goals, and goals that are drawn
// (GoalSampleableRegion), are taken as they come. One solve() ends with the first path, as PRM's does; the best one of
// the roadmap is the one with the smallest weighted length (path_search.h).
//
// Parameters: batch, free_share, neighbours, clearance_exponent and seed; SVMA also epsilon, most_steps, density.
//
// MedialAxisPlanner is the same with any retractor: MAPRM, UMAPRM. Instances may solve in several threads at once.
#pragma once

#include <ompl/base/Planner.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "partwise/motion/axis_planner.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/world.h"

namespace partwise {

class MedialAxisPlanner : public ompl::base::Planner {
 public:
  using MakeRetractor = std::function<std::unique_ptr<Retractor>(const Progress&)>;

  MedialAxisPlanner(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Scene> scene,
                    const std::string& name, MakeRetractor make, const AxisPlannerSettings& settings = {});
  ~MedialAxisPlanner() override;

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  void clear() override;
  void clearQuery() override;
  // Samples and the bends of edges; what starts and goals are is marked.
  void getPlannerData(ompl::base::PlannerData& data) const override;

  void set_batch(int count) { settings_.batch = count; }
  int batch() const { return settings_.batch; }
  void set_free_share(double share) { settings_.free_share = share; }
  double free_share() const { return settings_.free_share; }
  void set_neighbours(int count) { settings_.connecting.neighbours = count; }
  int neighbours() const { return settings_.connecting.neighbours; }
  void set_clearance_exponent(double exponent) { settings_.search.clearance_exponent = exponent; }
  double clearance_exponent() const { return settings_.search.clearance_exponent; }
  void set_seed(unsigned seed) { settings_.seed = seed; }
  unsigned seed() const { return static_cast<unsigned>(settings_.seed); }

 protected:
  const Scene& scene() const { return *scene_; }
  const AxisPlannerSettings& settings() const { return settings_; }

 private:
  // Starts and goals that came up since, valid ones only.
  void take_ends();
  const ompl::base::State* state_of(int sample) const;
  const std::vector<ompl::base::State*>& states_of(const RoadmapEdge& edge) const;
  void free_states();

  std::shared_ptr<const Scene> scene_;
  MakeRetractor make_;
  AxisPlannerSettings settings_;
  std::unique_ptr<Retractor> retract_;
  std::unique_ptr<AxisPlanner> planner_;
  std::vector<Configuration> starts_, goals_;  // not given to the planner yet
  int known_starts_ = 0, known_goals_ = 0;
  // What getPlannerData() has handed out: by sample, by edge.
  mutable std::vector<ompl::base::State*> states_;
  mutable std::map<std::pair<int, int>, std::vector<ompl::base::State*>> bends_;
};

class SVMA final : public MedialAxisPlanner {
 public:
  // `problem` as problem_scene() makes it (world.h); a World gives {world.scene, [=] { return world.contacts; }}.
  SVMA(const ompl::base::SpaceInformationPtr& si, const ProblemScene& problem);

  void set_epsilon(double epsilon) { push_.epsilon = epsilon; }
  double epsilon() const { return push_.epsilon; }
  void set_most_steps(int steps) { push_.most_steps = steps; }
  int most_steps() const { return push_.most_steps; }
  void set_density(double density) { field_.density = density; }
  double density() const { return field_.density; }

 private:
  std::unique_ptr<Retractor> trained(const ProblemScene& problem, const Progress& progress) const;

  MarginFieldSettings field_;
  MarginPushSettings push_;
};

}  // namespace partwise
