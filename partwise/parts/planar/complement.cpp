#include "partwise/parts/planar/complement.h"

#include <algorithm>
#include <map>
#include <unordered_set>

#include "partwise/base/error.h"
#include "partwise/parts/planar/planar_hull.h"
#include "partwise/parts/planar/pockets.h"

namespace partwise {
namespace {

IndexRing reversed(const IndexRing& ring) { return {ring.rbegin(), ring.rend()}; }

// Which region has an edge, in its own direction.
using EdgeOwners = std::map<IndexEdge, int>;

EdgeOwners owners_of(const std::vector<Region>& regions) {
  EdgeOwners owners;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for_each_edge(regions[r].outer, [&](int a, int b) { owners[{a, b}] = static_cast<int>(r); });
  }
  return owners;
}

// The ring rotated so that it begins with the edge a b, which it has.
IndexRing beginning_with(IndexRing ring, int a, int b) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == a && ring[(i + 1) % ring.size()] == b) {
      std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
      return ring;
    }
  }
  return ring;
}

class Builder {
 public:
  Builder(std::span<const Point2> points, const Region& region, double tolerance, const DecomposeRegion& decompose)
      : points_(points), region_(region), tolerance_(tolerance), decompose_(decompose) {}

  Complement build() {
    pockets_ = hull_pockets(points_, region_.outer);
    for (const IndexRing& chain : pockets_) add_pocket(chain);
    for (std::size_t h = 0; h < region_.holes.size(); ++h) add_hole(static_cast<int>(h));
    find_features();
    simplify();
    return std::move(result_);
  }

 private:
  void add_pocket(const IndexRing& chain) {
    const double depth = pocket_depth(points_, chain);
    result_.depth = std::max(result_.depth, depth);
    if (depth <= tolerance_) return;
    Region pocket;
    pocket.outer = reversed(chain);  // ends with the bridge, from the chain's first corner to its last
    const int a = chain.front(), b = chain.back();
    const std::vector<Region> chambers = decompose_(pocket);
    const EdgeOwners owners = owners_of(chambers);
    const int root = result_.hierarchy.add(-1, points_[a], points_[b]);
    hang(result_, chambers, owners, owners.at({a, b}), root, {a, b}, -1);
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      VertexConcavity& vertex = result_.vertices[chain[i]];
      vertex.value = std::max(vertex.value, distance_to_segment(points_[chain[i]], points_[a], points_[b]));
    }
  }

  // Hangs a chamber and all that is entered through it below a bridge. Returns how deep the tree gets.
  int hang(Complement& into, const std::vector<Region>& regions, const EdgeOwners& owners, int first, int bridge,
           IndexEdge edge, int hole) const {
    struct Entry {
      int region, bridge, level;
      IndexEdge edge;
    };
    std::vector<Entry> queue{{first, bridge, 1, edge}};
    int deepest = 1;
    for (std::size_t q = 0; q < queue.size(); ++q) {
      const Entry entry = queue[q];
      deepest = std::max(deepest, entry.level);
      const int chamber = static_cast<int>(into.chambers.size());
      into.chambers.push_back(
          {entry.bridge, beginning_with(regions[entry.region].outer, entry.edge.first, entry.edge.second), hole});
      for (int v : into.chambers.back().ring) {
        VertexConcavity& vertex = into.vertices[v];
        vertex.value = std::max(vertex.value, into.hierarchy.concavity(entry.bridge, points_[v]));
        vertex.chambers.push_back(chamber);
      }
      for_each_edge(into.chambers.back().ring, [&](int a, int b) {
        if (IndexEdge(a, b) == entry.edge) return;
        const auto other = owners.find({b, a});
        if (other == owners.end()) return;
        const int below = into.hierarchy.add(entry.bridge, points_[b], points_[a]);
        queue.push_back({other->second, below, entry.level + 1, {b, a}});
      });
    }
    return deepest;
  }

  void add_hole(int hole) {
    const IndexRing& ring = region_.holes[hole];
    const AntipodalPair pair = antipodal_pair(points_, ring);
    result_.depth = std::max(result_.depth, pair.depth);
    result_.noise.push_back(pair.depth <= tolerance_);
    if (result_.noise.back()) return;
    Region inside;
    inside.outer = reversed(ring);
    const std::vector<Region> chambers = decompose_(inside);
    if (chambers.size() == 1) {
      const int bridge = result_.hierarchy.add(-1, points_[pair.a], points_[pair.b]);
      hang(result_, chambers, {}, 0, bridge, {-1, -1}, hole);
      IndexRing& turned = result_.chambers.back().ring;
      std::rotate(turned.begin(), std::find(turned.begin(), turned.end(), pair.a), turned.end());
      antipodes_[static_cast<int>(result_.chambers.size()) - 1] = pair.b;
    } else {
      root_hole(chambers, hole);
    }
  }

  void root_hole(const std::vector<Region>& chambers, int hole) {
    const EdgeOwners owners = owners_of(chambers);
    IndexEdge best(-1, -1);
    std::pair<int, double> least;
    for (const auto& [edge, owner] : owners) {
      if (edge.first > edge.second || !owners.contains({edge.second, edge.first})) continue;
      Complement trial;
      const int depth = hang_both(trial, chambers, owners, edge, hole);
      double concavity = 0;
      for (const auto& [v, vertex] : trial.vertices) concavity = std::max(concavity, vertex.value);
      if (best.first < 0 || std::pair(depth, concavity) < least) best = edge, least = {depth, concavity};
    }
    hang_both(result_, chambers, owners, best, hole);
  }

  int hang_both(Complement& into, const std::vector<Region>& chambers, const EdgeOwners& owners, IndexEdge edge,
                int hole) const {
    const auto [a, b] = edge;
    const int bridge = into.hierarchy.add(-1, points_[a], points_[b]);
    const int one = hang(into, chambers, owners, owners.at({a, b}), bridge, {a, b}, hole);
    return std::max(one, hang(into, chambers, owners, owners.at({b, a}), bridge, {b, a}, hole));
  }

  // Corners of the approximation of a chamber's hull, less the ends of its bridge.
  std::vector<int> hull_features(int index) const {
    const Chamber& chamber = result_.chambers[index];
    std::vector<Point2> corners(chamber.ring.size());
    std::transform(chamber.ring.begin(), chamber.ring.end(), corners.begin(), [&](int v) { return points_[v]; });
    std::vector<int> hull = planar_hull(corners);
    std::sort(hull.begin(), hull.end());
    const auto chain = [&](int from, int to) {  // positions; from and to need not be on the hull
      IndexRing vertices{chamber.ring[from]};
      for (int h : hull) {
        if (h > from && h < to) vertices.push_back(chamber.ring[h]);
      }
      vertices.push_back(chamber.ring[static_cast<std::size_t>(to) % chamber.ring.size()]);
      return approximate_chain(points_, vertices, tolerance_);
    };
    const int n = static_cast<int>(chamber.ring.size());
    const auto antipode = antipodes_.find(index);
    if (antipode == antipodes_.end()) return chain(1, n);
    const int middle =
        static_cast<int>(std::find(chamber.ring.begin(), chamber.ring.end(), antipode->second) - chamber.ring.begin());
    std::vector<int> all = chain(0, middle);
    for (int v : chain(middle, n)) all.push_back(v);
    all.push_back(chamber.ring[0]);
    all.push_back(antipode->second);
    return all;
  }

  bool is_reflex(int v) const { return reflex_.contains(v); }

  void collect_reflex(const IndexRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int before = ring[(i + ring.size() - 1) % ring.size()], after = ring[(i + 1) % ring.size()];
      if (orientation(points_[before], points_[ring[i]], points_[after]) < 0) reflex_.insert(ring[i]);
    }
  }

  void find_features() {
    if (result_.chambers.empty()) return;
    collect_reflex(region_.outer);
    for (const IndexRing& hole : region_.holes) collect_reflex(hole);
    for (std::size_t c = 0; c < result_.chambers.size(); ++c) {
      for (int v : hull_features(static_cast<int>(c))) {
        const double concavity = result_.vertices.at(v).value;
        if (is_reflex(v) && (concavity > tolerance_ || result_.chambers[c].hole >= 0)) result_.features[v] = concavity;
      }
    }
    if (!result_.features.empty()) return;
    // Nothing on the hulls: the deepest vertex that can be cut at.
    int deepest = -1;
    for (const auto& [v, vertex] : result_.vertices) {
      if (!is_reflex(v)) continue;
      if (deepest < 0 || vertex.value > result_.vertices.at(deepest).value ||
          (vertex.value == result_.vertices.at(deepest).value && v < deepest)) {
        deepest = v;
      }
    }
    if (deepest >= 0) result_.features[deepest] = result_.vertices.at(deepest).value;
  }

  void simplify() {
    std::unordered_set<int> inner;  // strictly inside pockets
    for (const IndexRing& chain : pockets_) inner.insert(chain.begin() + 1, chain.end() - 1);
    const auto keep = [&](const IndexRing& ring, bool hull_too) {
      IndexRing kept;
      for (int v : ring) {
        if (result_.features.contains(v) || (hull_too && !inner.contains(v))) kept.push_back(v);
      }
      return kept;
    };
    result_.simplified.push_back(keep(region_.outer, true));
    for (std::size_t h = 0; h < region_.holes.size(); ++h) {
      if (!result_.noise[h]) result_.simplified.push_back(keep(region_.holes[h], false));
    }
  }

  std::span<const Point2> points_;
  const Region& region_;
  double tolerance_;
  const DecomposeRegion& decompose_;
  Complement result_;
  std::unordered_map<int, int> antipodes_;  // of chambers with a pseudo bridge: its other end
  std::unordered_set<int> reflex_;
  std::vector<IndexRing> pockets_;  // of the outer ring
};

}  // namespace

Complement measure_complement(std::span<const Point2> points, const Region& region, double tolerance,
                              const DecomposeRegion& decompose) {
  return Builder(points, region, tolerance, decompose).build();
}

}  // namespace partwise
