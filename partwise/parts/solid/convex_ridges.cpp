#include "partwise/parts/solid/convex_ridges.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <set>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

constexpr double kOnHullDepth = 0.5;  // of the tolerance

PartHull part_hull(const Mesh& hull, const std::vector<int>& local) {
  PartHull result{{}, hull_planes(hull)};
  for (const auto& f : hull.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(local[f[k]], local[f[(k + 1) % 3]]);
      if (a != b) result.edges.emplace_back(a, b);
    }
  }
  std::sort(result.edges.begin(), result.edges.end());
  result.edges.erase(std::unique(result.edges.begin(), result.edges.end()), result.edges.end());
  return result;
}

// The edges by one of their ends each, with few such ends, for one search serves all edges of an end: the end with most
// edges first (a greedy vertex cover).
struct EdgesOfSource {
  int source;
  std::vector<std::size_t> edges;
};

std::vector<EdgesOfSource> by_source(const std::vector<std::pair<int, int>>& edges, int vertices) {
  std::vector<std::vector<std::size_t>> at(static_cast<std::size_t>(vertices));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    at[edges[i].first].push_back(i);
    at[edges[i].second].push_back(i);
  }
  std::priority_queue<std::pair<std::size_t, int>> queue;
  std::vector<std::size_t> left(at.size());
  for (std::size_t v = 0; v < at.size(); ++v)
    if ((left[v] = at[v].size()) > 0) queue.push({left[v], -static_cast<int>(v)});
  std::vector<char> covered(edges.size(), 0);
  std::vector<EdgesOfSource> groups;
  while (!queue.empty()) {
    const auto [count, minus_v] = queue.top();
    queue.pop();
    const auto v = static_cast<std::size_t>(-minus_v);
    if (left[v] == 0) continue;
    if (count != left[v]) {
      queue.push({left[v], minus_v});
      continue;
    }
    groups.push_back({static_cast<int>(v), {}});
    for (const std::size_t i : at[v]) {
      if (covered[i]) continue;
      covered[i] = 1;
      groups.back().edges.push_back(i);
      --left[edges[i].first];
      --left[edges[i].second];
    }
  }
  return groups;
}

// Which vertices of a part are no deeper inside its hull than a depth; each is asked once.
class NearHull {
 public:
  NearHull(const PartGraph& part, const PartHull& hull, double depth)
      : part_(part), hull_(hull), depth_(depth), near_(part.vertices.size(), kUnknown) {}

  bool holds(const Valley& valley) {
    // From the middle outwards: there an ordinary valley is deep, which ends the search.
    const std::size_t n = valley.path.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = i % 2 ? n / 2 - (i + 1) / 2 : n / 2 + i / 2;
      if (k < n && !near(valley.path[k])) return false;
    }
    return true;
  }

 private:
  static constexpr signed char kUnknown = -1;

  bool near(int v) {
    if (near_[v] == kUnknown) {
      const Point p = part_.positions.row(v);
      const auto& planes = hull_.planes;
      near_[v] = 0;
      for (Eigen::Index f = 0; f < planes.rows() && !near_[v]; ++f)
        near_[v] = planes(f, 3) - planes(f, 0) * p[0] - planes(f, 1) * p[1] - planes(f, 2) * p[2] <= depth_;
    }
    return near_[v] != 0;
  }

  const PartGraph& part_;
  const PartHull& hull_;
  double depth_;
  std::vector<signed char> near_;
};

bool runs_inside(const SurfaceQuery& surface, const Point& a, const Point& b) {
  for (const double t : {0.5, 0.25, 0.75})
    if (!surface.contains((1 - t) * a + t * b)) return false;
  return true;
}

// Fills in profile and concavity of a valley whose path is known; returns the path's length.
double measure(Valley& valley, const PartGraph& part, NearHull& near_hull, double tolerance) {
  std::vector<Point> points(valley.path.size());
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = part.positions.row(valley.path[k]);
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  valley.profile = flatten_valley(points);
  const std::vector<double> concavity = valley_concavity(valley.profile, tolerance);
  valley.concavity = *std::max_element(concavity.begin(), concavity.end());
  valley.on_hull = valley.concavity > tolerance && near_hull.holds(valley);
  return length;
}

}  // namespace

PartHull part_hull(const PartGraph& part, double tolerance) {
  const ConvexHull hull = convex_hull(part.positions, kBridgeThickness * tolerance);
  return part_hull(hull.mesh, hull.source);
}

PartHull part_hull(const PartGraph& part, const Mesh& hull, std::span<const int> source) {
  std::vector<int> local;
  for (const int v : source) {
    const auto found = std::lower_bound(part.vertices.begin(), part.vertices.end(), v);
    PARTWISE_CHECK(*found, ==, v);
    local.push_back(static_cast<int>(found - part.vertices.begin()));
  }
  return part_hull(hull, local);
}

bool has_deep_valley(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance) {
  std::vector<std::pair<int, int>> edges = hull.edges;
  const auto span = [&](const std::pair<int, int>& e) {
    return (part.positions.row(e.first) - part.positions.row(e.second)).norm();
  };
  // Long bridges first: they are the likely ones.
  std::stable_sort(edges.begin(), edges.end(), [&](const auto& x, const auto& y) { return span(x) > span(y); });
  std::vector<std::vector<std::size_t>> at(part.vertices.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    at[edges[i].first].push_back(i);
    at[edges[i].second].push_back(i);
  }
  std::vector<char> settled(edges.size(), 0);
  PathSearch search(part);
  NearHull near_hull(part, hull, kOnHullDepth * tolerance);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (settled[i]) continue;
    const auto [a, b] = edges[i];
    if (std::isfinite(search.bounded_length(a, b, std::hypot(span(edges[i]), 2 * tolerance)))) continue;
    if (runs_inside(surface, part.positions.row(a), part.positions.row(b))) continue;
    // One search for all bridges of the end that has more of them.
    const int source = at[a].size() >= at[b].size() ? a : b;
    std::vector<int> targets;
    for (const std::size_t k : at[source])
      if (!settled[k]) targets.push_back(edges[k].first == source ? edges[k].second : edges[k].first);
    search.from(source, targets);
    for (const std::size_t k : at[source]) {
      if (settled[k]) continue;
      settled[k] = 1;
      Valley valley;
      valley.path = search.path_to(edges[k].first == source ? edges[k].second : edges[k].first);
      if (valley.path.empty()) continue;
      measure(valley, part, near_hull, tolerance);
      const Point p = part.positions.row(edges[k].first), q = part.positions.row(edges[k].second);
      if (valley.concavity > tolerance && !valley.on_hull && !runs_inside(surface, p, q)) return true;
    }
  }
  return false;
}

Bridges find_bridges(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance) {
  const auto& edges = hull.edges;
  tbb::enumerable_thread_specific<PathSearch> searches([&] { return PathSearch(part); });
  tbb::enumerable_thread_specific<NearHull> near_hulls([&] { return NearHull(part, hull, kOnHullDepth * tolerance); });

  // A path of length l over a bridge of length L is nowhere deeper than sqrt(l^2 - L^2) / 2: most are settled by that.
  std::vector<double> shallow_length(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    const auto [a, b] = edges[i];
    const double bridge = (part.positions.row(a) - part.positions.row(b)).norm();
    shallow_length[i] = searches.local().bounded_length(a, b, std::hypot(bridge, 2 * tolerance));
  });
  Bridges bridges;
  std::vector<std::pair<int, int>> open;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    if (!std::isfinite(shallow_length[i])) {
      open.push_back(edges[i]);
      continue;
    }
    bridges.shallow.push_back({a, b, shallow_length[i]});
    const double bridge = (part.positions.row(a) - part.positions.row(b)).norm();
    const double bound = std::sqrt(std::max(0.0, shallow_length[i] * shallow_length[i] - bridge * bridge)) / 2;
    bridges.concavity = std::max(bridges.concavity, bound);
  }

  std::vector<char> inside(open.size(), 0);
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
    inside[i] = runs_inside(surface, part.positions.row(open[i].first), part.positions.row(open[i].second));
  });
  std::erase_if(open, [&](const auto& bridge) { return inside[&bridge - open.data()] != 0; });

  // The others by their paths.
  const std::vector<EdgesOfSource> groups = by_source(open, part.size());
  std::vector<Valley> valleys(open.size());
  std::vector<double> lengths(open.size());
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    const auto& [source, bridges_here] = groups[g];
    const auto target = [&](std::size_t i) { return open[i].first == source ? open[i].second : open[i].first; };
    std::vector<int> targets;
    for (const std::size_t i : bridges_here) targets.push_back(target(i));
    PathSearch& search = searches.local();
    search.from(source, targets);
    for (const std::size_t i : bridges_here) {
      Valley& valley = valleys[i];
      valley.path = search.path_to(target(i));
      if (valley.path.empty()) continue;
      if (source != open[i].first) std::reverse(valley.path.begin(), valley.path.end());
      lengths[i] = measure(valley, part, near_hulls.local(), tolerance);
    }
  });
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (valleys[i].path.empty()) continue;  // Joined by nothing but the bridge.
    if (!valleys[i].on_hull) bridges.concavity = std::max(bridges.concavity, valleys[i].concavity);
    if (valleys[i].on_hull) {
      bridges.rims.push_back(std::move(valleys[i]));
    } else if (valleys[i].concavity > tolerance) {
      bridges.deep.push_back(std::move(valleys[i]));
    } else {
      bridges.shallow.push_back({open[i].first, open[i].second, lengths[i]});
    }
  }
  return bridges;
}

ConvexRidges convex_ridges(const PartGraph& part, const Bridges& bridges) {
  std::vector<int> cluster(static_cast<std::size_t>(part.size()), -1);
  for (const auto& s : bridges.shallow) cluster[s.a] = s.a, cluster[s.b] = s.b;
  std::vector<std::set<int>> apart(static_cast<std::size_t>(part.size()));  // clusters across a deep valley
  for (const Valley& v : bridges.deep) {
    const int a = v.path.front(), b = v.path.back();
    cluster[a] = a, cluster[b] = b;
    apart[a].insert(b);
    apart[b].insert(a);
  }
  const auto find = [&](int v) {
    while (cluster[v] != v) v = cluster[v] = cluster[cluster[v]];
    return v;
  };
  std::vector<Bridges::Shallow> order = bridges.shallow;
  std::sort(order.begin(), order.end(), [](const auto& x, const auto& y) {
    if (x.length != y.length) return x.length < y.length;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  for (const auto& bridge : order) {
    int a = find(bridge.a), b = find(bridge.b);
    if (a == b || apart[a].count(b)) continue;
    if (apart[a].size() < apart[b].size()) std::swap(a, b);
    cluster[b] = a;
    for (int other : apart[b]) {
      apart[other].erase(b);
      apart[other].insert(a);
      apart[a].insert(other);
    }
    apart[b].clear();
  }

  ConvexRidges ridges;
  ridges.of_vertex.assign(static_cast<std::size_t>(part.size()), -1);
  std::vector<int> number(static_cast<std::size_t>(part.size()), -1);
  for (int v = 0; v < part.size(); ++v) {
    if (cluster[v] < 0) continue;
    int& ridge = number[find(v)];
    if (ridge < 0) {
      ridge = static_cast<int>(ridges.members.size());
      ridges.members.emplace_back();
    }
    ridges.of_vertex[v] = ridge;
    ridges.members[ridge].push_back(v);
  }
  return ridges;
}

}  // namespace partwise
