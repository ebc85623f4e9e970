#include "partwise/parts/planar/part_joining.h"

#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <set>

#include "partwise/parts/planar/pockets.h"

namespace partwise {
namespace {

class Joiner {
 public:
  Joiner(std::span<const Point2> points, std::vector<Region> parts, double tolerance)
      : points_(points), tolerance_(tolerance), parts_(std::move(parts)), alive_(parts_.size(), true) {
    std::map<IndexEdge, int> owners;
    neighbours_.resize(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for_each_ring_edge(parts_[p], [&](int a, int b) { owners[{a, b}] = static_cast<int>(p); });
    }
    for (const auto& [edge, owner] : owners) {
      const auto other = owners.find({edge.second, edge.first});
      if (other != owners.end() && other->second != owner) neighbours_[owner].insert(other->second);
    }
  }

  std::vector<Region> join() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (int q : neighbours_[p]) {
        if (static_cast<int>(p) < q) offer(static_cast<int>(p), q);
      }
    }
    while (!queue_.empty()) {
      const auto [depth, p, q] = queue_.top();
      queue_.pop();
      if (alive_[p] && alive_[q]) merge(p, q);
    }
    std::vector<Region> left;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (alive_[p]) left.push_back(std::move(parts_[p]));
    }
    return left;
  }

 private:
  template <typename Visit>
  static void for_each_ring_edge(const Region& part, Visit&& visit) {
    for_each_edge(part.outer, visit);
    for (const IndexRing& hole : part.holes) for_each_edge(hole, visit);
  }

  // The union of two parts with a common edge, if it is within the tolerance, and its depth.
  std::optional<std::pair<Region, double>> united(int p, int q) const {
    const Region &small = parts_[p], &large = parts_[q];
    std::set<IndexEdge> other;
    for_each_ring_edge(small, [&](int a, int b) { other.insert({a, b}); });
    std::set<IndexEdge> shared;
    for_each_ring_edge(large, [&](int a, int b) {
      if (other.contains({b, a})) shared.insert({a, b}), shared.insert({b, a});
    });
    const auto touched = [&](const IndexRing& ring) {
      bool any = false;
      for_each_edge(ring, [&](int a, int b) { any = any || shared.contains({a, b}); });
      return any;
    };
    std::vector<IndexEdge> edges;
    std::vector<IndexRing> untouched;
    const auto add = [&](const IndexRing& ring) {
      for_each_edge(ring, [&](int a, int b) {
        if (!shared.contains({a, b})) edges.emplace_back(a, b);
      });
    };
    for (const Region* part : {&small, &large}) {
      add(part->outer);
      for (const IndexRing& hole : part->holes) touched(hole) ? add(hole) : untouched.push_back(hole);
    }
    Region region = trace_region(points_, std::move(edges));
    const double depth = region_depth(points_, region);  // The holes that nothing touched are within it already.
    if (depth > tolerance_) return std::nullopt;
    region.holes.insert(region.holes.end(), untouched.begin(), untouched.end());
    return std::pair(std::move(region), depth);
  }

  void offer(int p, int q) {
    if (const auto both = united(p, q)) queue_.emplace(both->second, p, q);
  }

  void merge(int p, int q) {
    auto both = united(p, q);
    alive_[p] = alive_[q] = false;
    const int merged = static_cast<int>(parts_.size());
    parts_.push_back(std::move(both->first));
    alive_.push_back(true);
    std::set<int> around = neighbours_[p];
    around.insert(neighbours_[q].begin(), neighbours_[q].end());
    neighbours_.emplace_back();
    for (int r : around) {
      if (!alive_[r]) continue;
      neighbours_[merged].insert(r);
      neighbours_[r].insert(merged);
      offer(r, merged);
    }
  }

  using Offer = std::tuple<double, int, int>;
  std::span<const Point2> points_;
  double tolerance_;
  std::vector<Region> parts_;
  std::vector<bool> alive_;
  std::vector<std::set<int>> neighbours_;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> queue_;
};

}  // namespace

std::vector<Region> join_parts(std::span<const Point2> points, std::vector<Region> parts, double tolerance) {
  if (parts.size() < 2) return parts;
  return Joiner(points, std::move(parts), tolerance).join();
}

}  // namespace partwise
