// The best path along a roadmap between any of some samples and any of others (Dijkstra 1959).
//
// The cost of an edge is its length over its clearance to the power of `clearance_exponent`: 0 for the shortest path, 1
// for the weighted length of Wein, van den Berg, Halperin 2008, which goes out of its way for room. An edge counts with
// its smallest clearance.
#pragma once

#include <optional>
#include <vector>

#include "partwise/motion/motion_path.h"
#include "partwise/motion/roadmap.h"

namespace partwise {

struct PathSearchSettings {
  double clearance_exponent = 1;  // 0 or more
};

// Nothing where the roadmap does not join them. A sample that is a start and a goal is a path of one configuration.
std::optional<MotionPath> path_search(const Roadmap& roadmap, const std::vector<AxisSample>& samples,
                                      const std::vector<int>& starts, const std::vector<int>& goals,
                                      const PathSearchSettings& settings = {});

}  // namespace partwise
