#include "partwise/parts/planar/skeleton.h"

#include <algorithm>
#include <array>
#include <map>

#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/orientation.h"

namespace partwise {
namespace {

// Centre of area.
Point2 centroid(const Polygon& polygon) {
  const Point2 origin = polygon.outer.row(0);
  Point2 moment = Point2::Zero();
  double twice = 0;
  const auto add = [&](const Ring& ring) {
    for (Eigen::Index i = 0; i < ring.rows(); ++i) {
      const Point2 a = ring.row(i).transpose() - origin;
      const Point2 b = ring.row((i + 1) % ring.rows()).transpose() - origin;
      twice += cross(a, b);
      moment += cross(a, b) * (a + b) / 3;
    }
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
  return twice != 0 ? Point2(origin + moment / twice) : origin;
}

// Cuts between the same parts, in groups that hang together.
std::vector<std::vector<const OutlineCut*>> joined_cuts(const std::vector<OutlineCut>& cuts) {
  DisjointSets sets(cuts.size());
  std::map<std::array<double, 4>, int> seen;  // parts and an end
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const double low = std::min(cuts[c].left, cuts[c].right), high = std::max(cuts[c].left, cuts[c].right);
    for (const Eigen::Vector2d& end : {cuts[c].a, cuts[c].b}) {
      const auto [known, fresh] = seen.try_emplace({low, high, end.x(), end.y()}, static_cast<int>(c));
      if (!fresh) sets.join(known->second, static_cast<int>(c));
    }
  }
  std::map<int, std::vector<const OutlineCut*>> groups;
  for (std::size_t c = 0; c < cuts.size(); ++c) groups[sets.find(static_cast<int>(c))].push_back(&cuts[c]);
  std::vector<std::vector<const OutlineCut*>> result;
  result.reserve(groups.size());
  for (auto& [name, members] : groups) result.push_back(std::move(members));
  return result;
}

Point2 middle(const std::vector<const OutlineCut*>& cuts) {
  Point2 sum = Point2::Zero();
  double length = 0;
  for (const OutlineCut* cut : cuts) {
    const double own = (cut->a - cut->b).norm();
    sum += own * (cut->a + cut->b) / 2, length += own;
  }
  return sum / length;
}

}  // namespace

Skeleton extract_skeleton(const Outline& outline) {
  Skeleton skeleton;
  for (std::size_t p = 0; p < outline.parts.size(); ++p) {
    skeleton.nodes.push_back({centroid(outline.parts[p]), SkeletonNodeKind::part, static_cast<int>(p)});
  }
  std::vector<std::vector<int>> cuts_of(outline.parts.size());
  for (const auto& group : joined_cuts(outline.cuts)) {
    const int node = static_cast<int>(skeleton.nodes.size());
    skeleton.nodes.push_back({middle(group), SkeletonNodeKind::cut, -1});
    for (int part : {group[0]->left, group[0]->right}) {
      cuts_of[part].push_back(node);
      skeleton.edges.emplace_back(node, part);
    }
  }
  for (std::size_t p = 0; p < cuts_of.size(); ++p) {
    if (cuts_of[p].size() != 1) continue;
    // The tip: the corner farthest along the way from the cut through the centre.
    const Point2 from = skeleton.nodes[cuts_of[p][0]].at, centre = skeleton.nodes[p].at;
    const Ring& outer = outline.parts[p].outer;
    Eigen::Index tip = 0;
    ((outer.rowwise() - from.transpose()) * (centre - from)).maxCoeff(&tip);
    skeleton.edges.emplace_back(static_cast<int>(p), static_cast<int>(skeleton.nodes.size()));
    skeleton.nodes.push_back({outer.row(tip).transpose(), SkeletonNodeKind::tip, static_cast<int>(p)});
  }
  return skeleton;
}

}  // namespace partwise
