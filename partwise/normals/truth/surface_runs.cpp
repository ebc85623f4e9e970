#include "partwise/normals/truth/surface_runs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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

std::vector<double> inverse_depths(const Image& depth) {
  std::vector<double> inverse;
  inverse.reserve(depth.values.size());
  for (const float z : depth.values) inverse.push_back(std::isfinite(z) && z > 0 ? 1 / static_cast<double>(z) : 0);
  return inverse;
}

PictureRuns picture_runs(std::span<const double> inverse_depth, int width, int height, const RunLimits& in_rows,
                         const RunLimits& in_columns) {
  const auto wide = static_cast<std::size_t>(width), high = static_cast<std::size_t>(height);
  PictureRuns runs{std::vector<Run>(inverse_depth.size()), std::vector<Run>(inverse_depth.size())};
  tbb::parallel_for(std::size_t{0}, high, [&](std::size_t y) {
    surface_runs(inverse_depth.subspan(y * wide, wide), in_rows, std::span(runs.rows).subspan(y * wide, wide));
  });
  tbb::parallel_for(std::size_t{0}, wide, [&](std::size_t x) {
    std::vector<double> line(high);
    std::vector<Run> found(high);
    for (std::size_t y = 0; y < high; ++y) line[y] = inverse_depth[y * wide + x];
    surface_runs(line, in_columns, found);
    for (std::size_t y = 0; y < high; ++y) runs.columns[y * wide + x] = found[y];
  });
  return runs;
}

RunLimits run_limits(double focal, double steepest_degrees) {
  RunLimits limits;
  limits.tolerance = 1 / focal;
  limits.steepest = std::tan(steepest_degrees * std::numbers::pi / 180) / focal;
  return limits;
}

}  // namespace partwise
