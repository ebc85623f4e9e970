#include "bench/ridges/ridge_match.h"

#include <Eigen/LU>

#include <algorithm>
#include <functional>
#include <limits>

namespace partwise::bench {
namespace {

// The point nearest to p of the simplex with these corners, at most four; leaves only those corners that it needs.
Point nearest_in_simplex(const Point& p, std::vector<Point>& corners) {
  double best = std::numeric_limits<double>::infinity();
  Point nearest = corners.front();
  std::vector<Point> needed = corners;
  for (unsigned subset = 1; subset < 1U << corners.size(); ++subset) {
    std::vector<Point> chosen;
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (subset >> k & 1U) chosen.push_back(corners[k]);
    const auto n = static_cast<Eigen::Index>(chosen.size()) - 1;
    Point point = chosen[0];
    if (n > 0) {
      Eigen::Matrix<double, Eigen::Dynamic, 3> sides(n, 3);
      for (Eigen::Index k = 0; k < n; ++k) sides.row(k) = chosen[static_cast<std::size_t>(k) + 1] - chosen[0];
      const Eigen::FullPivLU<Eigen::MatrixXd> gram(sides * sides.transpose());
      if (!gram.isInvertible()) continue;  // Flat: a smaller subset has the nearest point.
      const Eigen::VectorXd weight = gram.solve(sides * (p - chosen[0]).transpose());
      if (weight.minCoeff() < 0 || weight.sum() > 1) continue;
      point += weight.transpose() * sides;
    }
    if ((p - point).squaredNorm() < best) {
      best = (p - point).squaredNorm();
      nearest = point;
      needed = std::move(chosen);
    }
  }
  corners = std::move(needed);
  return nearest;
}

}  // namespace

double distance_to_hull(const Point& p, const Ridge& points) {
  constexpr double kPrecision = 1e-9;
  double size = 0;
  for (const Point& q : points) size = std::max(size, (q - p).norm());
  std::vector<Point> corners{points.front()};
  Point nearest = points.front();
  double distance = (p - nearest).norm();
  while (corners.size() < 4 && distance > kPrecision * size) {
    const Point* farthest = &points.front();
    for (const Point& q : points)
      if ((q - *farthest).dot(p - nearest) > 0) farthest = &q;
    // The hull lies behind the plane through the farthest point, so that it is no nearer to p than the plane.
    if ((*farthest - nearest).dot(p - nearest) <= kPrecision * size * distance) break;
    corners.push_back(*farthest);
    nearest = nearest_in_simplex(p, corners);
    if ((p - nearest).norm() >= distance) break;  // Rounding.
    distance = (p - nearest).norm();
  }
  return distance > kPrecision * size ? distance : 0;
}

double reach_out(const Ridge& a, const Ridge& b) {
  double farthest = 0;
  for (const Point& p : a) farthest = std::max(farthest, distance_to_hull(p, b));
  return farthest;
}

RidgeMatch match_ridges(const std::vector<Ridge>& a, const std::vector<Ridge>& b, double tolerance) {
  RidgeMatch match;
  std::vector<std::vector<int>> near(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (reach_out(a[i], b[j]) <= tolerance && reach_out(b[j], a[i]) <= tolerance)
        near[i].push_back(static_cast<int>(j));
  match.partner.assign(a.size(), -1);
  std::vector<int> holder(b.size(), -1);
  std::vector<char> seen;
  const std::function<bool(int)> place = [&](int i) {
    for (const int j : near[i]) {
      if (seen[j]) continue;
      seen[j] = 1;
      if (holder[j] >= 0 && !place(holder[j])) continue;
      holder[j] = i;
      match.partner[i] = j;
      return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    seen.assign(b.size(), 0);
    match.matched += place(static_cast<int>(i));
  }
  return match;
}

}  // namespace partwise::bench
