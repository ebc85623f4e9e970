#include "partwise/parts/solid/cup_repair.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

constexpr double kLeastGain = 1e-3;    // of the step: how much deeper each step of a walk must lead
constexpr double kLeastFacing = 1e-3;  // cosine: a bridge in the plane of a flat face is not above it

// Sums of the face normals about each vertex, weighted by area, of unit length or 0.
Vertices vertex_normals(const PartGraph& part) {
  Vertices normals = Vertices::Zero(part.size(), 3);
  for (const auto& c : part.corners) {
    const Point a = part.positions.row(c[0]);
    const Point normal = (part.positions.row(c[1]) - a).cross(part.positions.row(c[2]) - a);
    for (int v : c) normals.row(v) += normal;
  }
  normals.rowwise().normalize();
  return normals;
}

// From p up to the point of the segment (a, b) that it lies beneath.
std::optional<Point> up_to(const Point& p, const Point& a, const Point& b) {
  const double t = (p - a).dot(b - a) / (b - a).squaredNorm();
  if (!(t > 0 && t < 1)) return {};
  return a + t * (b - a) - p;
}

}  // namespace

Hollows::Hollows(const PartGraph& part, const PartHull& hull, double step, bool two_sided)
    : part_(part), step_(step), two_sided_(two_sided), normals_(vertex_normals(part)) {
  for (const auto& f : hull.mesh.faces.rowwise()) {
    const auto planes = hull_planes({Vertices(hull.mesh.vertices(f, Eigen::all)), Faces{{0, 1, 2}}});
    if (planes.rows() == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(hull.vertices[f[k]], hull.vertices[f[(k + 1) % 3]]);
      if (a != b) facets_.push_back({a, b, planes.row(0)});
    }
  }
  std::stable_sort(facets_.begin(), facets_.end(),
                   [](const Facet& x, const Facet& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
}

Hollows::Bridge Hollows::bridge(int a, int b) const {
  Bridge bridge{.a = part_.positions.row(a), .b = part_.positions.row(b), .facets = {}};
  const std::pair<int, int> ends = std::minmax(a, b);
  auto facet = std::lower_bound(facets_.begin(), facets_.end(), ends,
                                [](const Facet& f, const auto& e) { return std::pair(f.a, f.b) < e; });
  for (; facet != facets_.end() && std::pair(facet->a, facet->b) == ends; ++facet)
    bridge.facets.push_back(facet->plane);
  return bridge;
}

double Hollows::depth(int v, const Bridge& bridge, bool facing) const {
  const Point p = part_.positions.row(v);
  const std::optional<Point> up = up_to(p, bridge.a, bridge.b);
  if (!up || bridge.facets.empty()) return 0;
  if (facing) {
    const double cosine = up->dot(normals_.row(v));
    if ((two_sided_ ? std::abs(cosine) : cosine) <= kLeastFacing * up->norm()) return 0;
  }
  double depth = std::numeric_limits<double>::infinity();
  for (const Plane& plane : bridge.facets) depth = std::min(depth, plane[3] - p.dot(plane.head<3>()));
  return std::max(0.0, depth);
}

double Hollows::depth(int v, int a, int b) const { return depth(v, bridge(a, b), false); }

double Hollows::air(int v, int a, int b, const SurfaceQuery& surface) const {
  const Point p = part_.positions.row(v);
  const std::optional<Point> up = up_to(p, part_.positions.row(a), part_.positions.row(b));
  if (!up || up->norm() == 0) return 0;
  if (!two_sided_ && surface.contains(p + *up)) return 0;
  const SurfaceQuery::Hit hit = surface.first_hit(p + *up, -up->normalized(), 0);
  return hit.face < 0 ? up->norm() : std::min(hit.distance, up->norm());
}

Hollows::Bottom Hollows::descend(int v, int a, int b) const {
  const Bridge above = bridge(a, b);
  Bottom bottom{v, depth(v, above, true)};
  std::vector<char> seen(static_cast<std::size_t>(part_.size()), 0);
  std::vector<int> ball;
  for (;;) {
    const int centre = bottom.vertex;
    Bottom best = bottom;
    ball.assign(1, centre);
    seen[centre] = 1;
    for (std::size_t i = 0; i < ball.size(); ++i) {
      for (int k = part_.first[ball[i]]; k < part_.first[ball[i] + 1]; ++k) {
        const int w = part_.steps[k].to;
        if (seen[w]) continue;
        const bool near = (part_.positions.row(w) - part_.positions.row(centre)).norm() <= step_;
        if (!near && i > 0) continue;
        const double deep = depth(w, above, true);
        if (deep > best.depth) best = {w, deep};
        if (!near) continue;
        seen[w] = 1;
        ball.push_back(w);
      }
    }
    for (int w : ball) seen[w] = 0;
    if (best.depth <= bottom.depth + kLeastGain * step_) return bottom;
    bottom = best;
  }
}

std::vector<int> path_through(PathSearch& search, int a, int via, int b) {
  const std::array<int, 2> ends{a, b};
  search.from(via, ends);
  std::vector<int> path = search.path_to(a);
  const std::vector<int> rest = search.path_to(b);
  if (path.empty() || rest.empty()) return {};
  std::reverse(path.begin(), path.end());
  path.insert(path.end(), rest.begin() + 1, rest.end());
  return path;
}

}  // namespace partwise
