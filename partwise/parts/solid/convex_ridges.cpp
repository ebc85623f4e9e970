#include "partwise/parts/solid/convex_ridges.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

constexpr double kOnHullDepth = 0.25;  // of the tolerance
constexpr double kHollowStep = 0.5;    // of the tolerance: how far a walk into a hollow looks over flat places

std::vector<std::pair<int, int>> hull_edges(const ConvexHull& hull) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& f : hull.mesh.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(hull.source[f[k]], hull.source[f[(k + 1) % 3]]);
      if (a != b) edges.emplace_back(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// Whether no vertex of the valley is deeper inside the hull than `depth`.
bool runs_on_hull(const PartGraph& part, const Valley& valley,
                  const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>& planes, double depth) {
  // From the middle outwards: there an ordinary valley is deep, which ends the search.
  const std::size_t n = valley.path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = i % 2 ? n / 2 - (i + 1) / 2 : n / 2 + i / 2;
    if (k >= n) continue;
    const Point p = part.positions.row(valley.path[k]);
    bool near = false;
    for (Eigen::Index f = 0; f < planes.rows() && !near; ++f)
      near = planes(f, 3) - planes(f, 0) * p[0] - planes(f, 1) * p[1] - planes(f, 2) * p[2] <= depth;
    if (!near) return false;
  }
  return true;
}

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
double measure(Valley& valley, const PartGraph& part,
               const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>& planes, double tolerance) {
  const double length = flatten(valley, part, tolerance);
  valley.on_hull = valley.concavity > tolerance && runs_on_hull(part, valley, planes, kOnHullDepth * tolerance);
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

bool has_deep_valley(const PartGraph& part, const SurfaceQuery& surface, double tolerance, const CupRepair& repair) {
  const ConvexHull hull = convex_hull(part.positions, 1e-3 * tolerance);
  const auto planes = hull_planes(hull.mesh);
  std::vector<std::pair<int, int>> edges = hull_edges(hull);
  const auto span = [&](const std::pair<int, int>& e) {
    return (part.positions.row(e.first) - part.positions.row(e.second)).squaredNorm();
  };
  // Long bridges first: they are the likely ones.
  std::stable_sort(edges.begin(), edges.end(), [&](const auto& x, const auto& y) { return span(x) > span(y); });
  PathSearch search(part);
  std::optional<Hollows> hollows;
  for (const auto& [a, b] : edges) {
    const double bridge = std::sqrt(span({a, b}));
    if (std::isfinite(search.bounded_length(a, b, std::hypot(bridge, 2 * tolerance)))) continue;
    if (runs_inside(surface, part.positions.row(a), part.positions.row(b))) continue;
    const int target = b;
    search.from(a, std::span(&target, 1));
    Valley valley;
    valley.path = search.path_to(b);
    if (valley.path.empty()) continue;
    measure(valley, part, planes, tolerance);
    if (valley.concavity > tolerance && !valley.on_hull) return true;
    if (!valley.on_hull || !repair.on) continue;
    if (!hollows) hollows.emplace(part, hull, kHollowStep * tolerance, repair.two_sided);
    lead_through_hollow(valley, part, *hollows, search, surface, tolerance);
    if (!valley.on_hull) return true;
  }
  return false;
}

Bridges find_bridges(const PartGraph& part, const SurfaceQuery& surface, double tolerance, const CupRepair& repair) {
  const ConvexHull hull = convex_hull(part.positions, 1e-3 * tolerance);
  const auto planes = hull_planes(hull.mesh);
  const std::vector<std::pair<int, int>> edges = hull_edges(hull);
  tbb::enumerable_thread_specific<PathSearch> searches([&] { return PathSearch(part); });

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

  // The others by their paths, one search for all that start at the same vertex.
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < open.size(); ++i)
    if (i == 0 || open[i].first != open[i - 1].first) starts.push_back(i);
  std::vector<Valley> valleys(open.size());
  std::vector<double> lengths(open.size());
  std::vector<char> ignored(open.size(), 0);
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t s) {
    const std::size_t begin = starts[s], end = s + 1 < starts.size() ? starts[s + 1] : open.size();
    std::vector<int> targets;
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = open[i];
      ignored[i] = runs_inside(surface, part.positions.row(a), part.positions.row(b));
      if (!ignored[i]) targets.push_back(b);
    }
    if (targets.empty()) return;
    PathSearch& search = searches.local();
    search.from(open[begin].first, targets);
    for (std::size_t i = begin; i < end; ++i) {
      if (ignored[i]) continue;
      Valley& valley = valleys[i];
      valley.path = search.path_to(open[i].second);
      if (valley.path.empty()) {  // Joined by nothing but the bridge.
        ignored[i] = 1;
        continue;
      }
      lengths[i] = measure(valley, part, planes, tolerance);
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
    if (ignored[i]) continue;
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
