#include "partwise/motion/path_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace partwise {
namespace {

struct Reached {
  double cost = std::numeric_limits<double>::infinity();
  const RoadmapEdge* by = nullptr;  // none: a start
};

int other_end(const RoadmapEdge& edge, int sample) { return edge.from == sample ? edge.to : edge.from; }

// From the goal back to a start, then turned around.
MotionPath traced(const std::vector<Reached>& reached, const std::vector<AxisSample>& samples, int goal) {
  MotionPath path;
  int at = goal;
  path.configurations.push_back(samples[static_cast<std::size_t>(at)].q);
  while (const RoadmapEdge* edge = reached[static_cast<std::size_t>(at)].by) {
    std::vector<Configuration> bends = edge->between;
    if (at == edge->to) std::ranges::reverse(bends);
    path.configurations.insert(path.configurations.end(), bends.begin(), bends.end());
    at = other_end(*edge, at);
    path.configurations.push_back(samples[static_cast<std::size_t>(at)].q);
  }
  std::ranges::reverse(path.configurations);
  return path;
}

}  // namespace

std::optional<MotionPath> path_search(const Roadmap& roadmap, const std::vector<AxisSample>& samples,
                                      const std::vector<int>& starts, const std::vector<int>& goals,
                                      const PathSearchSettings& settings) {
  std::vector<std::vector<const RoadmapEdge*>> edges(samples.size());
  for (const RoadmapEdge& edge : roadmap.edges) {
    edges[static_cast<std::size_t>(edge.from)].push_back(&edge);
    edges[static_cast<std::size_t>(edge.to)].push_back(&edge);
  }
  std::vector<bool> wanted(samples.size(), false);
  for (const int goal : goals) wanted[static_cast<std::size_t>(goal)] = true;
  std::vector<Reached> reached(samples.size());
  using Open = std::pair<double, int>;  // the cost, and where to
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (const int start : starts) {
    reached[static_cast<std::size_t>(start)].cost = 0;
    open.emplace(0.0, start);
  }
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (cost > reached[static_cast<std::size_t>(at)].cost) continue;
    if (wanted[static_cast<std::size_t>(at)]) return traced(reached, samples, at);
    for (const RoadmapEdge* edge : edges[static_cast<std::size_t>(at)]) {
      const double next = cost + edge->length / std::pow(edge->clearance, settings.clearance_exponent);
      const int to = other_end(*edge, at);
      if (next >= reached[static_cast<std::size_t>(to)].cost) continue;
      reached[static_cast<std::size_t>(to)] = {next, edge};
      open.emplace(next, to);
    }
  }
  return std::nullopt;
}

}  // namespace partwise
