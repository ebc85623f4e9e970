#include "partwise/parts/planar/region.h"

#include <algorithm>
#include <map>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Whether w comes before x when turning clockwise about v from the direction of u.
bool clockwise_before(std::span<const Point2> points, int v, int u, int w, int x) {
  const auto half = [&](int at) {
    const int side = orientation(points[v], points[u], points[at]);
    if (side != 0) return side < 0 ? 0 : 2;
    return (points[at] - points[v]).dot(points[u] - points[v]) < 0 ? 1 : 3;
  };
  const int half_w = half(w), half_x = half(x);
  if (half_w != half_x) return half_w < half_x;
  return orientation(points[v], points[w], points[x]) < 0;
}

// Whether a simple ring runs counter-clockwise: it turns left at its lowest leftmost corner.
bool is_counter_clockwise(std::span<const Point2> points, const IndexRing& ring) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point2 &p = points[ring[i]], &best = points[ring[lowest]];
    if (p.x() < best.x() || (p.x() == best.x() && p.y() < best.y())) lowest = i;
  }
  const std::size_t n = ring.size();
  return orientation(points[ring[(lowest + n - 1) % n]], points[ring[lowest]], points[ring[(lowest + 1) % n]]) > 0;
}

std::vector<int> vertices_of(std::span<const IndexRing* const> rings) {
  std::vector<int> all;
  for (const IndexRing* ring : rings) all.insert(all.end(), ring->begin(), ring->end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<Point2> select(std::span<const Point2> points, const std::vector<int>& indices) {
  std::vector<Point2> chosen(indices.size());
  std::transform(indices.begin(), indices.end(), chosen.begin(), [&](int i) { return points[i]; });
  return chosen;
}

}  // namespace

Region trace_region(std::span<const Point2> points, std::vector<IndexEdge> edges) {
  std::sort(edges.begin(), edges.end());
  std::vector<bool> used(edges.size());
  Region region;
  std::unordered_map<int, std::size_t> position;  // of a vertex on the open path
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    // Walk with the region on the left; whenever a vertex returns, what was walked since is a ring of its own.
    IndexRing path{edges[start].first};
    position.clear();
    position[path[0]] = 0;
    for (std::size_t edge = start; !used[edge];) {
      used[edge] = true;
      const auto [from, at] = edges[edge];
      if (const auto seen = position.find(at); seen != position.end()) {
        IndexRing ring(path.begin() + static_cast<std::ptrdiff_t>(seen->second), path.end());
        for (std::size_t i = seen->second + 1; i < path.size(); ++i) position.erase(path[i]);
        path.resize(seen->second + 1);
        if (is_counter_clockwise(points, ring)) {
          PARTWISE_CHECK(region.outer.size(), ==, 0u);
          region.outer = std::move(ring);
        } else {
          region.holes.push_back(std::move(ring));
        }
      } else {
        position[at] = path.size();
        path.push_back(at);
      }
      // Where several edges leave a vertex, the next is the first one clockwise: it bounds the same wedge.
      std::size_t best = edges.size();
      for (auto k = std::lower_bound(edges.begin(), edges.end(), IndexEdge(at, -1)); k != edges.end() && k->first == at;
           ++k) {
        const auto candidate = static_cast<std::size_t>(k - edges.begin());
        if (used[candidate]) continue;
        if (best == edges.size() || clockwise_before(points, at, from, k->second, edges[best].second)) best = candidate;
      }
      if (best == edges.size()) break;
      edge = best;
    }
    PARTWISE_CHECK(path.size(), ==, 1u);
  }
  PARTWISE_CHECK(region.outer.size(), >=, 3u);
  return region;
}

RegionMesh::RegionMesh(std::span<const Point2> points, std::span<const IndexRing* const> rings)
    : points_(vertices_of(rings)), mesh_(select(points, points_)) {
  local_.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) local_[points_[i]] = static_cast<int>(i);
  for (const IndexRing* ring : rings) {
    for_each_edge(*ring, [&](int a, int b) { PARTWISE_CHECK(mesh_.insert_edge(local(a), local(b)), ==, true); });
  }
  mesh_.mark_inside();
}

std::vector<Region> RegionMesh::split(std::span<const Point2> points,
                                      const std::function<bool(int, int)>& is_cut) const {
  const auto triangles = mesh_.triangles();
  std::vector<int> region_of(triangles.size(), -1);
  const auto ends = [&](std::size_t t, int i) {
    return IndexEdge(triangles[t].v[(i + 1) % 3], triangles[t].v[(i + 2) % 3]);
  };
  int regions = 0;
  std::vector<std::size_t> stack;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (!triangles[seed].inside || region_of[seed] >= 0) continue;
    region_of[seed] = regions++;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::size_t t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const int u = triangles[t].neighbour[i];
        if (u < 0 || !triangles[u].inside || region_of[u] >= 0) continue;
        const auto [a, b] = ends(t, i);
        if (is_cut(a, b)) continue;
        region_of[u] = region_of[t];
        stack.push_back(static_cast<std::size_t>(u));
      }
    }
  }
  std::vector<std::vector<IndexEdge>> bounds(static_cast<std::size_t>(regions));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].inside) continue;
    for (int i = 0; i < 3; ++i) {
      const int u = triangles[t].neighbour[i];
      if (u >= 0 && region_of[u] == region_of[t]) continue;
      const auto [a, b] = ends(t, i);
      bounds[region_of[t]].emplace_back(point(a), point(b));
    }
  }
  std::vector<Region> result;
  result.reserve(bounds.size());
  for (auto& edges : bounds) result.push_back(trace_region(points, std::move(edges)));
  return result;
}

IndexedPolygon to_region(const Polygon& polygon) {
  IndexedPolygon result;
  std::map<std::pair<double, double>, int> names;
  const auto indices = [&](const Ring& ring) {
    IndexRing named;
    for (const auto& corner : ring.rowwise()) {
      // 0 and -0 are the same place.
      const auto [found, fresh] =
          names.try_emplace({corner.x() + 0.0, corner.y() + 0.0}, static_cast<int>(result.points.size()));
      if (fresh) result.points.emplace_back(corner.transpose());
      named.push_back(found->second);
    }
    return named;
  };
  result.region.outer = indices(polygon.outer);
  for (const Ring& hole : polygon.holes) result.region.holes.push_back(indices(hole));
  return result;
}

Polygon to_polygon(std::span<const Point2> points, const Region& region) {
  const auto ring = [&](const IndexRing& indices) {
    Ring corners(static_cast<Eigen::Index>(indices.size()), 2);
    for (std::size_t i = 0; i < indices.size(); ++i) corners.row(static_cast<Eigen::Index>(i)) = points[indices[i]];
    return corners;
  };
  Polygon polygon{ring(region.outer), {}};
  for (const IndexRing& hole : region.holes) polygon.holes.push_back(ring(hole));
  return polygon;
}

}  // namespace partwise
