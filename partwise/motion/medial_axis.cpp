#include "partwise/motion/medial_axis.h"

#include <algorithm>
#include <vector>

namespace partwise {
namespace {

// Of the nearest obstacles, nearest first: the first, and the first that can be told apart from it.
std::array<Near, 2> told_apart(const std::vector<Near>& nearest) {
  std::array<Near, 2> pair;
  if (nearest.empty()) return pair;
  pair[0] = nearest.front();
  const auto second = std::ranges::find_if(
      nearest, [&](const Near& each) { return (each.gradient - pair[0].gradient).norm() >= least_separation; });
  if (second != nearest.end()) pair[1] = *second;
  return pair;
}

}  // namespace

AxisState axis_state(const Scene& scene, const Configuration& q) {
  AxisState state;
  state.free = scene.free(q);
  for (const int looked_at : {2, 6}) {  // mostly the first two are the two
    const std::vector<Near> nearest = scene.nearest(q, looked_at);
    state.pair = told_apart(nearest);
    if (state.pair[1].obstacle >= 0 || std::ssize(nearest) < looked_at) break;
  }
  return state;
}

}  // namespace partwise
