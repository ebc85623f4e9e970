#include "partwise/parts/planar/noise_detours.h"

#include <algorithm>
#include <cstdint>
#include <queue>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace partwise {
namespace {

constexpr double longest_detour = 2;  // times the diagonal
constexpr double hole_discount = 0.5;

std::vector<const IndexRing*> rings_of(const Region& region) {
  std::vector<const IndexRing*> rings{&region.outer};
  for (const IndexRing& hole : region.holes) rings.push_back(&hole);
  return rings;
}

class Detours {
 public:
  Detours(std::span<const Point2> points, const Region& region, const std::vector<bool>& noise)
      : points_(points), region_(region), mesh_(points, rings_of(region)) {
    for (std::size_t h = 0; h < region.holes.size(); ++h) {
      if (!noise[h]) continue;
      for (int v : region.holes[h]) hole_of_[v] = static_cast<int>(h);
    }
    // A corner where a hole touches another ring is no place to pass.
    for (int v : region.outer) hole_of_.erase(v);
  }

  void add_straight(int a, int b) {
    mesh_.mesh().insert_edge(mesh_.local(a), mesh_.local(b));
    cuts_.insert(sorted(a, b));
  }

  bool is_straight(int a, int b) const {
    const auto walk = mesh_.mesh().walk(mesh_.local(a), mesh_.local(b));
    return walk.inside && walk.crossed.empty() && !walk.through_vertex;
  }

  // The shortest way from a to b over edges between holes, holes themselves crossed at a discount. Holes that were
  // entered are left at their best corner.
  void add_detour(int a, int b) {
    const double limit = longest_detour * (points_[a] - points_[b]).norm();
    std::unordered_map<int, double> distance{{a, 0}};
    std::unordered_map<int, int> before;
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.emplace(0, a);
    const auto reach = [&](int from, int to, double way) {
      if (way + (points_[to] - points_[b]).norm() * hole_discount > limit) return;
      const auto known = distance.find(to);
      if (known != distance.end() && known->second <= way) return;
      distance[to] = way, before[to] = from;
      queue.emplace(way, to);
    };
    while (!queue.empty()) {
      const auto [way, v] = queue.top();
      queue.pop();
      if (way > distance.at(v)) continue;
      if (v == b) break;
      for (int end : mesh_.mesh().inside_neighbours(mesh_.local(v))) {
        const int u = mesh_.point(end);
        if (u == b || hole_of_.contains(u)) reach(v, u, way + (points_[u] - points_[v]).norm());
      }
      const auto hole = hole_of_.find(v);
      if (hole == hole_of_.end() || v == a) continue;
      for (int u : region_.holes[hole->second]) {
        if (u != v && hole_of_.contains(u)) reach(v, u, way + hole_discount * (points_[u] - points_[v]).norm());
      }
    }
    if (!before.contains(b)) return;
    for (int v = b; v != a; v = before.at(v)) {
      const int u = before.at(v);
      const auto one = hole_of_.find(u), other = hole_of_.find(v);
      const bool through = one != hole_of_.end() && other != hole_of_.end() && one->second == other->second;
      if (!through) cuts_.insert(sorted(u, v));
    }
  }

  std::vector<Region> split() const {
    return mesh_.split(points_, [&](int a, int b) { return cuts_.contains(sorted(mesh_.point(a), mesh_.point(b))); });
  }

 private:
  std::span<const Point2> points_;
  const Region& region_;
  RegionMesh mesh_;
  std::unordered_map<int, int> hole_of_;  // of the corners of noise holes
  std::set<IndexEdge> cuts_;
};

}  // namespace

std::vector<Region> split_region(std::span<const Point2> points, const Region& region, const std::vector<bool>& noise,
                                 std::span<const IndexEdge> diagonals) {
  Detours detours(points, region, noise);
  std::vector<IndexEdge> bent;
  for (const auto& [a, b] : diagonals) {
    if (detours.is_straight(a, b)) {
      detours.add_straight(a, b);
    } else {
      bent.emplace_back(a, b);
    }
  }
  for (const auto& [a, b] : bent) detours.add_detour(a, b);
  return detours.split();
}

std::vector<Region> split_at(std::span<const Point2> points, const Region& region, std::span<const int> vertices) {
  const RegionMesh mesh(points, rings_of(region));
  const std::unordered_set<int> at(vertices.begin(), vertices.end());
  return mesh.split(points, [&](int a, int b) { return at.contains(mesh.point(a)) || at.contains(mesh.point(b)); });
}

std::vector<Region> split_everywhere(std::span<const Point2> points, const Region& region) {
  const RegionMesh mesh(points, rings_of(region));
  return mesh.split(points, [](int, int) { return true; });
}

}  // namespace partwise
