#include "partwise/parts/solid/convex_ridges.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace partwise {
namespace {

constexpr double kHollowStep = 0.5;  // of the tolerance: how far a walk into a hollow looks over flat places

// The end of each edge that its path is sought from: one search serves all edges of an end, so the end with more. It
// depends on the hull alone, for of equally short paths the source decides which is found.
std::vector<int> sources(const PartHull& hull, int vertices) {
  std::vector<int> edges_at(static_cast<std::size_t>(vertices), 0), source;
  for (const auto& [a, b] : hull.edges) ++edges_at[a], ++edges_at[b];
  for (const auto& [a, b] : hull.edges) source.push_back(edges_at[b] > edges_at[a] ? b : a);
  return source;
}

int other_end(const std::pair<int, int>& edge, int end) { return edge.first == end ? edge.second : edge.first; }

// The path of an edge after a search from one of its ends; in the direction of the edge.
std::vector<int> path_of(const PathSearch& search, const std::pair<int, int>& edge, int source) {
  std::vector<int> path = search.path_to(other_end(edge, source));
  if (source != edge.first) std::reverse(path.begin(), path.end());
  return path;
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

// Fills in profile, concavity and deepest vertex of a valley whose path is known; returns the path's length.
double flatten(Valley& valley, const PartGraph& part, double tolerance) {
  std::vector<Point> points(valley.path.size());
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = part.positions.row(valley.path[k]);
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  valley.profile = flatten_valley(points);
  const std::vector<double> concavity = valley_concavity(valley.profile, tolerance);
  const auto deepest = std::max_element(concavity.begin(), concavity.end());
  valley.concavity = *deepest;
  valley.deepest = valley.path[static_cast<std::size_t>(deepest - concavity.begin())];
  return length;
}

// The same, and whether it is a rim.
double measure(Valley& valley, const PartGraph& part, NearHull& near_hull, double tolerance) {
  const double length = flatten(valley, part, tolerance);
  valley.on_hull = valley.concavity > tolerance && near_hull.holds(valley);
  return length;
}

// The repair for cups: where a rim's hollow is deeper than the tolerance, the rim becomes a valley, through the bottom
// unless its deepest vertex is in the hollow already. Returns the hollow's depth.
double lead_through_hollow(Valley& rim, const PartGraph& part, const Hollows& hollows, PathSearch& search,
                           const SurfaceQuery& surface, double tolerance) {
  const int a = rim.path.front(), b = rim.path.back();
  double depth = hollows.depth(rim.deepest, a, b);
  if (depth > tolerance) depth = std::min(depth, hollows.air(rim.deepest, a, b, surface));
  if (depth > tolerance) {
    rim.on_hull = false;
    rim.through_hollow = true;
    return depth;
  }
  const Hollows::Bottom bottom = hollows.descend(rim.deepest, a, b);
  if (bottom.depth <= tolerance) return std::max(depth, bottom.depth);
  Valley valley;
  valley.path = path_through(search, a, bottom.vertex, b);
  flatten(valley, part, tolerance);
  // A flattened path that crosses itself is measured by other bridges than this one, and may seem shallower.
  valley.concavity = std::max(valley.concavity, bottom.depth);
  valley.through_hollow = true;
  rim = std::move(valley);
  return bottom.depth;
}

}  // namespace

bool has_deep_valley(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance,
                     const CupRepair& repair, double rim_depth) {
  const auto& edges = hull.edges;
  const std::vector<int> source = sources(hull, part.size());
  std::vector<std::vector<std::size_t>> of_source(part.vertices.size());
  for (std::size_t i = 0; i < edges.size(); ++i) of_source[source[i]].push_back(i);
  // Long bridges first: they are the likely ones.
  std::vector<std::pair<double, std::size_t>> order;  // minus the length; the edge
  for (std::size_t i = 0; i < edges.size(); ++i)
    order.emplace_back(-(part.positions.row(edges[i].first) - part.positions.row(edges[i].second)).norm(), i);
  std::sort(order.begin(), order.end());
  std::vector<char> settled(edges.size(), 0);
  PathSearch search(part);
  NearHull near_hull(part, hull, rim_depth * tolerance);
  std::optional<Hollows> hollows;
  std::vector<Valley> rims;  // kept until the search's paths have been read: the repair searches anew
  for (const auto& [minus_length, i] : order) {
    if (settled[i]) continue;
    const auto [a, b] = edges[i];
    if (search.has_path(a, b, std::hypot(minus_length, 2 * tolerance))) continue;
    if (runs_inside(surface, part.positions.row(a), part.positions.row(b))) continue;
    std::vector<std::size_t> together;
    std::vector<int> targets;
    for (const std::size_t k : of_source[source[i]]) {
      if (settled[k]) continue;
      settled[k] = 1;
      together.push_back(k);
      targets.push_back(other_end(edges[k], source[k]));
    }
    search.from(source[i], targets);
    for (const std::size_t k : together) {
      Valley valley;
      valley.path = path_of(search, edges[k], source[k]);
      if (valley.path.empty()) continue;
      measure(valley, part, near_hull, tolerance);
      if (valley.concavity <= tolerance) continue;
      if (runs_inside(surface, part.positions.row(edges[k].first), part.positions.row(edges[k].second))) continue;
      if (!valley.on_hull) return true;
      if (repair.on) rims.push_back(std::move(valley));
    }
    if (!rims.empty() && !hollows) hollows.emplace(part, hull, kHollowStep * tolerance, repair.two_sided);
    for (Valley& rim : rims) {
      lead_through_hollow(rim, part, *hollows, search, surface, tolerance);
      if (!rim.on_hull) return true;
    }
    rims.clear();
  }
  return false;
}

Bridges find_bridges(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance,
                     const CupRepair& repair, double rim_depth) {
  const auto& edges = hull.edges;
  const std::vector<int> source = sources(hull, part.size());
  tbb::enumerable_thread_specific<PathSearch> searches([&] { return PathSearch(part); });
  tbb::enumerable_thread_specific<NearHull> near_hulls([&] { return NearHull(part, hull, rim_depth * tolerance); });

  // A path of length l over a bridge of length L is nowhere deeper than sqrt(l^2 - L^2) / 2: most are settled by that.
  std::vector<double> shallow_length(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    const auto [a, b] = edges[i];
    const double bridge = (part.positions.row(a) - part.positions.row(b)).norm();
    shallow_length[i] = searches.local().bounded_length(a, b, std::hypot(bridge, 2 * tolerance));
  });
  Bridges bridges;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    if (!std::isfinite(shallow_length[i])) {
      open.push_back(i);
      continue;
    }
    bridges.shallow.push_back({a, b, shallow_length[i]});
    const double bridge = (part.positions.row(a) - part.positions.row(b)).norm();
    const double bound = std::sqrt(std::max(0.0, shallow_length[i] * shallow_length[i] - bridge * bridge)) / 2;
    bridges.concavity = std::max(bridges.concavity, bound);
  }

  std::vector<char> inside(edges.size(), 0);
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
    const auto [a, b] = edges[open[i]];
    inside[open[i]] = runs_inside(surface, part.positions.row(a), part.positions.row(b));
  });
  std::erase_if(open, [&](std::size_t i) { return inside[i] != 0; });

  // The others by their paths.
  std::map<int, std::vector<std::size_t>> by_source;
  for (std::size_t i = 0; i < open.size(); ++i) by_source[source[open[i]]].push_back(i);
  const std::vector<std::pair<int, std::vector<std::size_t>>> groups(by_source.begin(), by_source.end());
  std::vector<Valley> valleys(open.size());
  std::vector<double> lengths(open.size());
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    const auto& [from, together] = groups[g];
    std::vector<int> targets;
    for (const std::size_t i : together) targets.push_back(other_end(edges[open[i]], from));
    PathSearch& search = searches.local();
    search.from(from, targets);
    for (const std::size_t i : together) {
      valleys[i].path = path_of(search, edges[open[i]], from);
      if (!valleys[i].path.empty()) lengths[i] = measure(valleys[i], part, near_hulls.local(), tolerance);
    }
  });
  const auto is_rim = [](const Valley& v) { return v.on_hull; };
  if (repair.on && std::any_of(valleys.begin(), valleys.end(), is_rim)) {
    const Hollows hollows(part, hull, kHollowStep * tolerance, repair.two_sided);
    std::vector<double> hollow(open.size(), 0.0);
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
      if (is_rim(valleys[i]))
        hollow[i] = lead_through_hollow(valleys[i], part, hollows, searches.local(), surface, tolerance);
    });
    bridges.concavity = std::max(bridges.concavity, *std::max_element(hollow.begin(), hollow.end()));
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (valleys[i].path.empty()) continue;  // Joined by nothing but the bridge.
    if (!valleys[i].on_hull) bridges.concavity = std::max(bridges.concavity, valleys[i].concavity);
    if (valleys[i].on_hull) {
      bridges.rims.push_back(std::move(valleys[i]));
    } else if (valleys[i].concavity > tolerance) {
      bridges.deep.push_back(std::move(valleys[i]));
    } else {
      bridges.shallow.push_back({edges[open[i]].first, edges[open[i]].second, lengths[i]});
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
