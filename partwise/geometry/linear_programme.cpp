#include "partwise/geometry/linear_programme.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace partwise {
namespace {

constexpr double tolerance = 1e-12;

}  // namespace

Optimum minimise(const Eigen::Vector3d& cost, std::span<const HalfSpace> half_spaces, double bound) {
  Eigen::Vector3d tilted = cost;
  const double tilt = 1e-9 * cost.norm();
  for (const HalfSpace& h : half_spaces) tilted += tilt * h.normal;

  // The basis: three planes of whose normals the cost is a combination with weights that are not negative. Three sides
  // of the cube are one.
  std::array<HalfSpace, 3> basis;
  std::array<bool, 3> from_cube{true, true, true};
  for (int k = 0; k < 3; ++k) {
    const double sign = tilted[k] >= 0 ? 1 : -1;
    basis[k] = {sign * Eigen::Vector3d::Unit(k), -bound};
  }
  const int limit = 50 + 10 * static_cast<int>(half_spaces.size());  // Only rounding can make it run in circles.
  for (int step = 0; step < limit; ++step) {
    // Rows of the inverse transposed: the reciprocal basis.
    std::array<Eigen::Vector3d, 3> reciprocal{basis[1].normal.cross(basis[2].normal),
                                              basis[2].normal.cross(basis[0].normal),
                                              basis[0].normal.cross(basis[1].normal)};
    const double scale = 1 / basis[0].normal.dot(reciprocal[0]);
    for (auto& r : reciprocal) r *= scale;
    const Eigen::Vector3d x =
        basis[0].offset * reciprocal[0] + basis[1].offset * reciprocal[1] + basis[2].offset * reciprocal[2];

    // The most violated of the first eight half-spaces, or else of the next eight, and so on.
    std::size_t entering = half_spaces.size();
    double worst = tolerance;
    for (std::size_t i = 0; i < half_spaces.size(); ++i) {
      if (i % 8 == 0 && entering < i) break;
      const double violation = half_spaces[i].offset - half_spaces[i].normal.dot(x);
      if (violation > worst) worst = violation, entering = i;
    }
    if (entering == half_spaces.size()) {
      const bool on_cube = from_cube[0] || from_cube[1] || from_cube[2] || !(x.lpNorm<Eigen::Infinity>() < bound);
      return {on_cube ? Optimum::Status::unbounded : Optimum::Status::optimal, x};
    }

    // Which plane leaves: the one whose weight first falls to zero as the weight of the entering one grows.
    int leaving = -1;
    double least = 0, share_of_leaving = 0;
    for (int k = 0; k < 3; ++k) {
      const double share = reciprocal[k].dot(half_spaces[entering].normal);
      if (share <= tolerance) continue;
      const double ratio = std::max(reciprocal[k].dot(tilted), 0.0) / share;
      if (leaving < 0 || ratio < least || (ratio == least && share > share_of_leaving))
        leaving = k, least = ratio, share_of_leaving = share;
    }
    if (leaving < 0) return {};
    basis[leaving] = half_spaces[entering];
    from_cube[leaving] = false;
  }
  return {};
}

}  // namespace partwise
