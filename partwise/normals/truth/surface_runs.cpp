#include "partwise/normals/truth/surface_runs.h"

#include <algorithm>
#include <cmath>

namespace partwise {
namespace {

// From a pixel that is known to the next one that is.
struct Link {
  int from = 0, to = 0;
  double step = 0;   // of inverse depth, a pixel
  double noise = 0;  // of the step
  bool near = false, plausible = false;
};

Link link(std::span<const double> line, int from, int to, const RunLimits& limits) {
  const double a = line[static_cast<std::size_t>(from)], b = line[static_cast<std::size_t>(to)];
  Link result{from, to};
  result.step = (b - a) / (to - from);
  result.noise = limits.noise / (to - from);
  result.near = to - from - 1 <= limits.widest_gap;
  result.plausible = result.near && std::abs(result.step) <= limits.steepest * (a + b) / 2 + result.noise;
  return result;
}

bool joins(const Link* before, const Link& here, const Link* behind, double tolerance) {
  if (!here.plausible) return false;
  const bool has_before = before != nullptr && before->plausible, has_behind = behind != nullptr && behind->plausible;
  if (!has_before && !has_behind) return true;
  // Beside the end of a line, of two steps that differ the smaller one is believed.
  const double one = has_before ? before->step : 0, other = has_behind ? behind->step : 0;
  const double allowed = tolerance + here.noise;
  return here.step >= std::min(one, other) - allowed && here.step <= std::max(one, other) + allowed;
}

}  // namespace

void surface_runs(std::span<const double> line, const RunLimits& limits, std::span<Run> runs) {
  std::vector<Link> links;
  int previous = -1;
  for (int i = 0; i < static_cast<int>(line.size()); ++i) {
    runs[static_cast<std::size_t>(i)] = {};
    if (line[static_cast<std::size_t>(i)] == 0) continue;
    runs[static_cast<std::size_t>(i)] = {i, i};
    if (previous >= 0) links.push_back(link(line, previous, i, limits));
    previous = i;
  }
  const auto run_of = [&](int i) -> Run& { return runs[static_cast<std::size_t>(i)]; };
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Link& here = links[k];
    const Link* before = k > 0 ? &links[k - 1] : nullptr;
    const Link* behind = k + 1 < links.size() ? &links[k + 1] : nullptr;
    const double value = line[static_cast<std::size_t>(here.from)];
    if (joins(before, here, behind, limits.tolerance * value)) run_of(here.to).first = run_of(here.from).first;
  }
  for (auto each = links.rbegin(); each != links.rend(); ++each) {
    if (run_of(each->to).first != each->to) run_of(each->from).last = run_of(each->to).last;
  }
}

}  // namespace partwise
