#include "partwise/parts/planar/hierarchical_concavity.h"

#include <algorithm>
#include <limits>

#include "partwise/parts/planar/planar_hull.h"

namespace partwise {

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

double segment_distance(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double side_c = cross(b - a, c - a), side_d = cross(b - a, d - a);
  const double side_a = cross(d - c, a - c), side_b = cross(d - c, b - c);
  if (side_c * side_d < 0 && side_a * side_b < 0) return 0;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

int BridgeHierarchy::add(int parent, const Point2& a, const Point2& b) {
  double to_root = 0;
  if (parent >= 0) {
    const Node& up = nodes_[parent];
    to_root = up.to_root + segment_distance(a, b, up.a, up.b);
  }
  nodes_.push_back({parent, a, b, to_root});
  return size() - 1;
}

double BridgeHierarchy::concavity(int bridge, const Point2& p) const {
  const Node& node = nodes_[bridge];
  return distance_to_segment(p, node.a, node.b) + node.to_root;
}

namespace {

// Measures the pocket made of the vertices chain[0] .. chain.back() of `points` below its bridge, which is in `tree`.
void measure_chamber(std::span<const Point2> points, std::vector<int> chain, BridgeHierarchy& tree, int bridge,
                     double tolerance, std::vector<double>& concavity) {
  while (chain.size() > 3) {
    // The deepest bulge into the chamber: the vertex farthest inside from the hull edge that spans it.
    std::vector<Point2> corner(chain.size());
    std::transform(chain.begin(), chain.end(), corner.begin(), [&](int i) { return points[i]; });
    const std::vector<int> hull = planar_hull(corner);
    if (hull.size() < 3) break;
    std::vector<int> on_hull = hull;
    std::sort(on_hull.begin(), on_hull.end());
    int bulge = -1, from = 0, to = 0;
    double deepest = tolerance;
    for (std::size_t h = 0; h + 1 < on_hull.size(); ++h) {
      for (int m = on_hull[h] + 1; m < on_hull[h + 1]; ++m) {
        const double depth = distance_to_segment(corner[m], corner[on_hull[h]], corner[on_hull[h + 1]]);
        if (depth > deepest) deepest = depth, bulge = m, from = on_hull[h], to = on_hull[h + 1];
      }
    }
    if (bulge < 0) break;

    // Cut from the bulge to the nearest vertex beyond its own hull edge; what the cut closes off becomes a child.
    int across = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (int q = 0; q < static_cast<int>(corner.size()); ++q) {
      if (q >= from && q <= to) continue;
      const double length = (corner[q] - corner[bulge]).norm();
      if (length < nearest) nearest = length, across = q;
    }
    if (across < 0) break;  // The hull edge spans the whole chamber: the bulge is the chamber's own shape.
    const int first = std::min(bulge, across), last = std::max(bulge, across);
    if (first == 0 && last == static_cast<int>(chain.size()) - 1) break;
    const std::vector<int> child(chain.begin() + first, chain.begin() + last + 1);
    const int below = tree.add(bridge, corner[first], corner[last]);
    measure_chamber(points, child, tree, below, tolerance, concavity);
    chain.erase(chain.begin() + first + 1, chain.begin() + last);
    if (last - first < 2) break;  // Neighbours: nothing was closed off.
  }
  for (int i : chain) concavity[i] = std::min(concavity[i], tree.concavity(bridge, points[i]));
}

}  // namespace

std::vector<double> hierarchical_concavity(std::span<const Point2> pocket, double tolerance) {
  std::vector<double> concavity(pocket.size(), std::numeric_limits<double>::infinity());
  if (pocket.empty()) return concavity;
  std::vector<int> chain(pocket.size());
  for (std::size_t i = 0; i < chain.size(); ++i) chain[i] = static_cast<int>(i);
  BridgeHierarchy tree;
  tree.add(-1, pocket.front(), pocket.back());
  measure_chamber(pocket, std::move(chain), tree, 0, tolerance, concavity);
  return concavity;
}

}  // namespace partwise
