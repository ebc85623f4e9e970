// Planning along the medial axis by any retractor: a roadmap of samples of the axis grows, starts and goals among its
// samples, until a path joins one of each (Liu 2017, Fig. 5.1 with SVMA; MAPRM and UMAPRM as peers).
//
// Samples come in batches, later ones larger, each joined to all before the next is drawn. Starts and goals are pushed
// to the axis as well. A share of the samples are plain free configurations: where there is no axis, far from obstacles
// or beside a single one, the roadmap is a plain one (Kavraki et al. 1996), so that any path with room around it is
// found in the end. After the first batch another share is drawn about what starts and goals reach (reached_region.h):
// out of a trap, or through a passage that is a small part of the bounds, there is a way step by step where there is
// none by chance.
//
// The same roadmap for any number of threads. After Cancelled everything goes on from the last batch that was joined.
// Errors: CheckFailed for starts and goals that are not free.
#pragma once

#include <optional>

#include "partwise/motion/path_search.h"

namespace partwise {

struct AxisPlannerSettings {
  int batch = 100;           // samples of the first batch; later ones have a 32nd of what there is, if that is more
  double free_share = 0.1;   // of plain samples
  double near_share = 0.5;   // of the others, drawn about what starts and goals reach
  bool only_on_axis = true;  // drop what the retractor did not bring to the axis (axis_samples.h)
  RoadmapSettings connecting{.cycles = false};
  PathSearchSettings search{};
  std::uint64_t seed = 0;
};

class AxisPlanner {
 public:
  // Which must outlive this.
  AxisPlanner(const Scene& scene, const Retractor& retract, const AxisPlannerSettings& settings = {});

  void add_start(const Configuration& q) { starts_.push_back(add_end(q)); }
  void add_goal(const Configuration& q) { goals_.push_back(add_end(q)); }

  // Starts and goals stay samples, but paths no longer begin or end there.
  void forget_ends();
  // Joins those that came since, to each other and to all.
  void join_ends(const Progress& progress = {});
  // Draws a batch and joins it.
  void grow(const Progress& progress = {});
  // The best path by now, if there is one. Edges about it are completed, and about the better one that this gives, and
  // so on, as long as there is time: never Cancelled.
  std::optional<MotionPath> path(const Progress& progress = {});
  // Grows until there is a path. Without one this ends by Cancelled only.
  MotionPath solve(const Progress& progress);

  const GrowingRoadmap& roadmap() const { return growing_; }
  const std::vector<int>& starts() const { return starts_; }  // samples of the roadmap
  const std::vector<int>& goals() const { return goals_; }

 private:
  int add_end(const Configuration& q);
  std::vector<AxisSample> even_samples(int count, const Progress& progress);
  std::vector<AxisSample> near_samples(int count, const Progress& progress);
  std::vector<AxisSample> plain_samples(int count);

  const Scene& scene_;
  const Retractor& retract_;
  AxisPlannerSettings settings_;
  GrowingRoadmap growing_;
  std::vector<int> starts_, goals_;
  std::vector<AxisSample> waiting_;  // ends brought to the axis, not joined yet
  bool joined_ = true;               // all ends
  std::size_t old_ = 0;              // samples that came before the last batch
  long drawn_ = 0, near_drawn_ = 0, plain_drawn_ = 0;
};

}  // namespace partwise
