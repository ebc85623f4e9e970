#include "partwise/parts/planar/pockets.h"

#include <algorithm>
#include <limits>

#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/planar_hull.h"

namespace partwise {
namespace {

std::vector<int> hull_positions(std::span<const Point2> points, const IndexRing& ring) {
  std::vector<Point2> corners(ring.size());
  std::transform(ring.begin(), ring.end(), corners.begin(), [&](int i) { return points[i]; });
  return planar_hull(corners);
}

double chord_error(std::span<const Point2> points, const IndexRing& chain, std::size_t from, std::size_t to) {
  double error = 0;
  for (std::size_t k = from + 1; k < to; ++k) {
    error = std::max(error, distance_to_segment(points[chain[k]], points[chain[from]], points[chain[to]]));
  }
  return error;
}

// Leaves out corners one after the other while the chords stay within the tolerance.
IndexRing thinned(std::span<const Point2> points, const IndexRing& chain, double tolerance) {
  IndexRing kept{chain.front()};
  for (std::size_t from = 0; from + 1 < chain.size();) {
    std::size_t to = from + 1;
    while (to + 1 < chain.size() && chord_error(points, chain, from, to + 1) <= tolerance) ++to;
    kept.push_back(chain[to]);
    from = to;
  }
  return kept;
}

}  // namespace

std::vector<IndexRing> hull_pockets(std::span<const Point2> points, const IndexRing& ring) {
  std::vector<int> hull = hull_positions(points, ring);
  if (hull.size() < 3) return {};
  // The hull begins at its leftmost corner; along the ring it may begin anywhere.
  std::rotate(hull.begin(), std::min_element(hull.begin(), hull.end()), hull.end());
  std::vector<IndexRing> pockets;
  const int n = static_cast<int>(ring.size());
  for (std::size_t h = 0; h < hull.size(); ++h) {
    const int from = hull[h], to = h + 1 < hull.size() ? hull[h + 1] : hull[0] + n;
    const Point2 &a = points[ring[from]], &b = points[ring[to % n]];
    IndexRing chain{ring[from]};
    for (int i = from + 1; i <= to; ++i) {
      const int v = ring[i % n];
      chain.push_back(v);
      if (i < to && orientation(a, b, points[v]) != 0) continue;  // strictly inside the hull
      if (chain.size() > 2) pockets.push_back(chain);
      chain = {v};
    }
  }
  return pockets;
}

double pocket_depth(std::span<const Point2> points, const IndexRing& chain) {
  double depth = 0;
  for (int v : chain) {
    depth = std::max(depth, distance_to_segment(points[v], points[chain.front()], points[chain.back()]));
  }
  return depth;
}

AntipodalPair antipodal_pair(std::span<const Point2> points, const IndexRing& ring) {
  const std::vector<int> hull = hull_positions(points, ring);
  const std::size_t n = hull.size();
  const auto at = [&](std::size_t i) -> const Point2& { return points[ring[hull[i % n]]]; };
  AntipodalPair pair{ring[hull[0]], ring[hull[n > 1 ? 1 : 0]], 0};
  double farthest = -1;
  const auto consider = [&](std::size_t i, std::size_t j) {
    const double length = (at(i) - at(j)).squaredNorm();
    if (length > farthest) farthest = length, pair.a = ring[hull[i % n]], pair.b = ring[hull[j % n]];
  };
  std::size_t opposite = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 side = at(i + 1) - at(i);
    consider(i, opposite), consider(i + 1, opposite);
    while (cross(side, at(opposite + 1) - at(opposite)) > 0) {
      ++opposite;
      consider(i, opposite), consider(i + 1, opposite);
    }
    // Parallel sides: both ends of the one opposite count.
    consider(i, opposite + 1), consider(i + 1, opposite + 1);
  }
  for (int v : ring) pair.depth = std::max(pair.depth, distance_to_segment(points[v], points[pair.a], points[pair.b]));
  return pair;
}

double region_depth(std::span<const Point2> points, const Region& region) {
  double depth = 0;
  for (const IndexRing& chain : hull_pockets(points, region.outer)) {
    depth = std::max(depth, pocket_depth(points, chain));
  }
  for (const IndexRing& hole : region.holes) depth = std::max(depth, antipodal_pair(points, hole).depth);
  return depth;
}

std::vector<int> approximate_chain(std::span<const Point2> points, IndexRing chain, double tolerance) {
  if (chain.size() > 128) {
    chain = thinned(points, chain, tolerance / 16);
    tolerance *= 15.0 / 16;
  }
  const std::size_t n = chain.size();
  if (n < 3) return {};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> chord(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      // Longer chords leave more: once clearly too much, no need to look.
      chord[i][j] = chord[i][j - 1] > 4 * tolerance ? infinite : chord_error(points, chain, i, j);
    }
  }
  std::vector<double> error(n);  // of the best way from the first corner to this one, with as many chords as rounds
  for (std::size_t j = 0; j < n; ++j) error[j] = chord[0][j];
  std::vector<std::vector<std::size_t>> before;
  while (error[n - 1] > tolerance) {
    std::vector<double> better(n, infinite);
    std::vector<std::size_t> from(n, 0);
    for (std::size_t j = 1; j < n; ++j) {
      for (std::size_t i = 1; i < j; ++i) {
        const double through = std::max(error[i], chord[i][j]);
        if (through < better[j]) better[j] = through, from[j] = i;
      }
    }
    error = std::move(better);
    before.push_back(std::move(from));
  }
  std::vector<int> kept;
  std::size_t at = n - 1;
  for (std::size_t round = before.size(); round-- > 0;) kept.push_back(chain[at = before[round][at]]);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

}  // namespace partwise
