#include "partwise/geometry/linear_programme.h"

#include <algorithm>
#include <cmath>

namespace partwise {
namespace {

constexpr double tolerance = 1e-12;

}  // namespace

// The optimum over the cube and the first `count` rows; false when there is no such point.
template <int D>
bool LinearProgramme::minimise(const std::array<double, D>& cost, const Row<D>* rows, std::size_t count,
                               std::array<double, D>& x) {
  const auto start = [&](double c) { return std::abs(c) <= negligible_ ? 0.0 : c > 0 ? -bound_ : bound_; };
  if constexpr (D == 1) {
    double low = -bound_, high = bound_;
    for (std::size_t i = 0; i < count; ++i) {
      const double n = rows[i].normal[0], d = rows[i].offset;
      if (n > 0) low = std::max(low, d / n);
      if (n < 0) high = std::min(high, d / n);
    }
    if (low > high + tolerance) return false;
    x[0] = std::clamp(start(cost[0]), std::min(low, high), std::max(low, high));
    return true;
  } else {
    for (int k = 0; k < D; ++k) x[k] = start(cost[k]);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [normal, offset] = rows[i];
      double value = -offset;
      for (int k = 0; k < D; ++k) value += normal[k] * x[k];
      if (value >= -tolerance) continue;

      // On the plane of row i: x_p is expressed by the others, p the coordinate with the largest coefficient.
      int p = 0;
      for (int k = 1; k < D; ++k)
        if (std::abs(normal[k]) > std::abs(normal[p])) p = k;
      auto& reduced = [this]() -> auto& {
        if constexpr (D == 3)
          return rows2_;
        else
          return rows1_;
      }
      ();
      reduced.clear();
      std::array<double, D - 1> share{}, reduced_cost{}, y{};
      for (int k = 0, j = 0; k < D; ++k) {
        if (k == p) continue;
        share[j] = normal[k] / normal[p];
        reduced_cost[j++] = cost[k] - cost[p] * normal[k] / normal[p];
      }
      const double level = offset / normal[p];
      for (std::size_t other = 0; other < i; ++other) {
        Row<D - 1> row{};
        double largest = 0;
        for (int k = 0, j = 0; k < D; ++k) {
          if (k == p) continue;
          row.normal[j] = rows[other].normal[k] - rows[other].normal[p] * share[j];
          largest = std::max(largest, std::abs(row.normal[j++]));
        }
        row.offset = rows[other].offset - rows[other].normal[p] * level;
        if (largest <= tolerance) {  // Parallel planes: all of this one is inside the other, or nothing.
          if (row.offset > tolerance) return false;
          continue;
        }
        for (double& n : row.normal) n /= largest;
        row.offset /= largest;
        reduced.push_back(row);
      }
      if (!minimise<D - 1>(reduced_cost, reduced.data(), reduced.size(), y)) return false;
      x[p] = level;
      for (int k = 0, j = 0; k < D; ++k) {
        if (k == p) continue;
        x[k] = y[j];
        x[p] -= share[j] * y[j];
        ++j;
      }
    }
    return true;
  }
}

LinearProgramme::Status LinearProgramme::solve(const Eigen::Vector3d& cost, std::span<const HalfSpace> half_spaces,
                                               double bound, Eigen::Vector3d& x) {
  bound_ = bound;
  negligible_ = 1e-12 * cost.lpNorm<Eigen::Infinity>();
  rows3_.clear();
  for (const HalfSpace& h : half_spaces) rows3_.push_back({{h.normal[0], h.normal[1], h.normal[2]}, h.offset});
  std::array<double, 3> y{};
  if (!minimise<3>({cost[0], cost[1], cost[2]}, rows3_.data(), rows3_.size(), y)) return Status::infeasible;
  x << y[0], y[1], y[2];
  return x.lpNorm<Eigen::Infinity>() >= bound * (1 - 1e-9) ? Status::unbounded : Status::optimal;
}

}  // namespace partwise
