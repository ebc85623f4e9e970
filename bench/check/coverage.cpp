#include "bench/check/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace partwise::bench {
namespace {

struct Volumes {
  double hulls = 0, solid = 0, uncovered = 0;
};

std::vector<Interval> united(std::vector<Interval> intervals) {
  std::ranges::sort(intervals);
  std::vector<Interval> result;
  for (const Interval& next : intervals) {
    if (result.empty() || next.first > result.back().second)
      result.push_back(next);
    else
      result.back().second = std::max(result.back().second, next.second);
  }
  return result;
}

double length(const std::vector<Interval>& intervals) {
  double sum = 0;
  for (const auto& [first, second] : intervals) sum += second - first;
  return sum;
}

// Both lists in order and disjoint.
double common_length(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  double sum = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    sum += std::max(0.0, std::min(i->second, j->second) - std::max(i->first, j->first));
    if (i->second < j->second)
      ++i;
    else
      ++j;
  }
  return sum;
}

Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Vector v(normal(random), normal(random), normal(random));
  return v / std::sqrt(v.squared_length());
}

Volumes measure_once(const Solid& solid, const std::vector<Point>& points, const std::vector<Hull>& hulls, int lines,
                     std::mt19937_64& random) {
  const Vector w = random_direction(random);
  Vector u = CGAL::cross_product(w, random_direction(random));
  u = u / std::sqrt(u.squared_length());
  const Vector axes[3] = {u, CGAL::cross_product(w, u), w};
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = std::numeric_limits<double>::infinity();
    high[k] = -low[k];
    for (const Point& p : points) {
      const double at = axes[k] * (p - CGAL::ORIGIN);
      low[k] = std::min(low[k], at);
      high[k] = std::max(high[k], at);
    }
  }
  const double cell = std::max(high[0] - low[0], high[1] - low[1]) / lines;
  const double margin = 0.01 * (high[2] - low[2]);
  const double reach = high[2] - low[2] + 2 * margin;
  std::uniform_real_distribution<double> uniform;
  Volumes sum;
  for (double y = low[1]; y < high[1]; y += cell)
    for (double x = low[0]; x < high[0]; x += cell)
      for (bool drawn = false; !drawn;) {
        const double at[2] = {x + cell * uniform(random), y + cell * uniform(random)};
        const Point p = CGAL::ORIGIN + at[0] * axes[0] + at[1] * axes[1] + (low[2] - margin) * axes[2];
        const Point q = p + reach * axes[2];
        std::vector<Interval> in_solid;
        if (solid.closed()) {
          auto clipped = solid.clip(p, q);
          if (!clipped) continue;
          in_solid = std::move(*clipped);
        }
        drawn = true;
        std::vector<Interval> in_hulls;
        for (const Hull& hull : hulls)
          if (const auto interval = hull.clip(p, q)) in_hulls.push_back(*interval);
        in_hulls = united(std::move(in_hulls));
        sum.hulls += length(in_hulls);
        sum.solid += length(in_solid);
        sum.uncovered += length(in_solid) - common_length(in_solid, in_hulls);
      }
  const double scale = cell * cell * reach;
  return {sum.hulls * scale, sum.solid * scale, sum.uncovered * scale};
}

struct Estimate {
  double value, error;
};

// Ratio of two means over the repetitions, with the standard error of the ratio (delta method).
Estimate ratio(const std::vector<Volumes>& runs, double Volumes::*above, double Volumes::*below) {
  const double n = static_cast<double>(runs.size());
  double sum_above = 0, sum_below = 0, squares = 0;
  for (const Volumes& run : runs) sum_above += run.*above, sum_below += run.*below;
  const double value = sum_above / sum_below;
  for (const Volumes& run : runs) squares += std::pow(run.*above - value * run.*below, 2);
  return {value, std::sqrt(squares / (n - 1) / n) / (sum_below / n)};
}

Estimate mean(const std::vector<Volumes>& runs, double Volumes::*member) {
  const double n = static_cast<double>(runs.size());
  double sum = 0, squares = 0;
  for (const Volumes& run : runs) sum += run.*member;
  for (const Volumes& run : runs) squares += std::pow(run.*member - sum / n, 2);
  return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

}  // namespace

Coverage measure_coverage(const Solid& solid, const Shape& shape, const std::vector<Hull>& hulls,
                          const CoverageSettings& settings) {
  std::vector<Point> points = shape.vertices;
  for (const Hull& hull : hulls) points.insert(points.end(), hull.vertices().begin(), hull.vertices().end());
  std::mt19937_64 random(settings.seed);
  std::vector<Volumes> runs;
  const double none = std::numeric_limits<double>::quiet_NaN();
  while (true) {
    runs.push_back(measure_once(solid, points, hulls, settings.lines, random));
    const int count = static_cast<int>(runs.size());
    if (count < settings.repetitions_min) continue;
    const Estimate hull_volume = mean(runs, &Volumes::hulls);
    const Estimate of_solid = solid.closed() ? ratio(runs, &Volumes::hulls, &Volumes::solid) : Estimate{none, none};
    const Estimate goal = solid.closed() ? of_solid : hull_volume;
    if (goal.error > settings.relative_error * goal.value && count < settings.repetitions_max) continue;
    const Estimate uncovered =
        solid.closed() ? ratio(runs, &Volumes::uncovered, &Volumes::solid) : Estimate{none, none};
    return {hull_volume.value, hull_volume.error, solid.closed() ? mean(runs, &Volumes::solid).value : none,
            of_solid.value,    of_solid.error,    uncovered.value,
            uncovered.error};
  }
}

}  // namespace partwise::bench
