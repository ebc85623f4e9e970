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

constexpr std::ptrdiff_t steps_each_side = 2;

bool joins(std::span<const Link> links, std::ptrdiff_t k, double tolerance) {
  const Link& here = links[static_cast<std::size_t>(k)];
  if (!here.plausible) return false;
  double least = INFINITY, most = -INFINITY;
  int sides = 0;
  for (const int side : {-1, 1}) {
    bool some = false;
    for (std::ptrdiff_t i = 1; i <= steps_each_side; ++i) {
      const std::ptrdiff_t other = k + side * i;
      if (other < 0 || other >= std::ssize(links) || !links[static_cast<std::size_t>(other)].plausible) break;
      const double step = links[static_cast<std::size_t>(other)].step;
      least = std::min(least, step), most = std::max(most, step), some = true;
    }
    // Beside the end of a line, of two steps that differ the smaller one is believed.
    sides += some ? 1 : 0;
    if (!some) least = std::min(least, 0.0), most = std::max(most, 0.0);
  }
  const double allowed = tolerance + here.noise;
  return sides == 0 || (here.step >= least - allowed && here.step <= most + allowed);
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
    const double tolerance = limits.tolerance * line[static_cast<std::size_t>(here.from)];
    if (joins(links, static_cast<std::ptrdiff_t>(k), tolerance)) run_of(here.to).first = run_of(here.from).first;
  }
  for (auto each = links.rbegin(); each != links.rend(); ++each) {
    if (run_of(each->to).first != each->to) run_of(each->from).last = run_of(each->to).last;
  }
}

}  // namespace partwise
