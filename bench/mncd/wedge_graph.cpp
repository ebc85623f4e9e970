#include "bench/mncd/wedge_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "partwise/geometry/disjoint_sets.h"

namespace bench {
namespace {

double angle_of(const Point2& from, const Point2& to) { return std::atan2(to.y() - from.y(), to.x() - from.x()); }

std::vector<const partwise::IndexRing*> rings_of(const partwise::Region& region) {
  std::vector<const partwise::IndexRing*> rings{&region.outer};
  for (const partwise::IndexRing& hole : region.holes) rings.push_back(&hole);
  return rings;
}

}  // namespace

WedgeGraph::WedgeGraph(std::span<const Point2> points, const partwise::Region& region, const std::set<IndexEdge>& cuts)
    : points_(points) {
  const auto rings = rings_of(region);
  partwise::RegionMesh mesh(points, rings);
  for (const partwise::IndexRing* ring : rings) {
    partwise::for_each_edge(*ring, [&](int a, int b) {
      add_spoke(a, b, true);
      add_spoke(b, a, false);
    });
  }
  for (const auto& [a, b] : cuts) {
    mesh.mesh().insert_edge(mesh.local(a), mesh.local(b));
    add_spoke(a, b, true);
    add_spoke(b, a, true);
  }
  make_nodes();
  for (const partwise::IndexRing* ring : rings) {
    partwise::for_each_edge(*ring, [&](int a, int b) { join_along(a, b); });
  }
  for (const auto& [a, b] : cuts) {
    join_along(a, b);
    join_along(b, a);
  }
  for (auto a = spokes_.begin(); a != spokes_.end(); ++a) {
    for (auto b = std::next(a); b != spokes_.end(); ++b) {
      const auto ends_there = [&](const Spoke& spoke) { return spoke.end == b->first; };
      if (std::any_of(a->second.begin(), a->second.end(), ends_there)) continue;
      const auto walk = mesh.mesh().walk(mesh.local(a->first), mesh.local(b->first));
      if (!walk.inside || walk.through_vertex || !walk.crossed.empty()) continue;
      const int from = node_towards(a->first, b->first), to = node_towards(b->first, a->first);
      if (from < 0 || to < 0) continue;
      neighbours_[from].push_back(to);
      neighbours_[to].push_back(from);
    }
  }
}

void WedgeGraph::add_spoke(int from, int to, bool inside_follows) {
  spokes_[from].push_back({angle_of(points_[from], points_[to]), to, inside_follows ? 0 : -1});
}

void WedgeGraph::make_nodes() {
  for (auto& [corner, spokes] : spokes_) {
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (spokes[i].node < 0) continue;
      double width = spokes[(i + 1) % spokes.size()].angle - spokes[i].angle;
      if (width <= 0) width += 2 * std::numbers::pi;
      spokes[i].node = size();
      corner_.push_back(corner);
      bends_.push_back(width >= std::numbers::pi - 1e-12);
    }
  }
  neighbours_.resize(corner_.size());
}

void WedgeGraph::join_along(int from, int to) {
  const auto index = [&](int at, int end) {
    const auto& spokes = spokes_.at(at);
    return static_cast<std::size_t>(
        std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& spoke) { return spoke.end == end; }) -
        spokes.begin());
  };
  const auto& there = spokes_.at(to);
  const int a = spokes_.at(from)[index(from, to)].node;
  const int b = there[(index(to, from) + there.size() - 1) % there.size()].node;
  if (a < 0 || b < 0) return;
  neighbours_[a].push_back(b);
  neighbours_[b].push_back(a);
}

int WedgeGraph::node_towards(int from, int to) const {
  const auto& spokes = spokes_.at(from);
  const double angle = angle_of(points_[from], points_[to]);
  const auto after = std::upper_bound(spokes.begin(), spokes.end(), angle,
                                      [](double value, const Spoke& spoke) { return value < spoke.angle; });
  return after == spokes.begin() ? spokes.back().node : std::prev(after)->node;
}

std::vector<int> WedgeGraph::components() const {
  partwise::DisjointSets sets(corner_.size());
  for (int node = 0; node < size(); ++node) {
    for (int other : neighbours_[node]) sets.join(node, other);
  }
  std::vector<int> component;
  for (int node = 0; node < size(); ++node) component.push_back(sets.find(node));
  return component;
}

WedgeGraph::Paths WedgeGraph::paths_from(int node) const {
  Paths paths{std::vector<double>(corner_.size(), std::numeric_limits<double>::infinity()),
              std::vector<int>(corner_.size(), -1)};
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  paths.length[node] = 0;
  open.emplace(0, node);
  while (!open.empty()) {
    const auto [length, at] = open.top();
    open.pop();
    if (length > paths.length[at] || (at != node && !bends_[at])) continue;
    for (int next : neighbours_[at]) {
      const double longer = length + (points_[corner_[at]] - points_[corner_[next]]).norm();
      if (longer >= paths.length[next]) continue;
      paths.length[next] = longer;
      paths.before[next] = at;
      open.emplace(longer, next);
    }
  }
  return paths;
}

std::vector<int> WedgeGraph::path_to(const Paths& paths, int node) const {
  std::vector<int> path;
  for (int at = node; at >= 0; at = paths.before[at]) path.push_back(corner_[at]);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace bench
