#include "partwise/parts/solid/cup_repair.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace partwise {
namespace {

constexpr double kLeastGain = 1e-3;    // of the step's length: what a step of the walk must be deeper
constexpr double kLeastFacing = 1e-3;  // cosine: rounding must not make a bridge in a flat face's plane lie above it

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

}  // namespace

Hollows::Hollows(const PartGraph& part, const ConvexHull& hull, double step)
    : part_(part), step_(step), normals_(vertex_normals(part)) {
  for (const auto& f : hull.mesh.faces.rowwise()) {
    const auto planes = hull_planes({Vertices(hull.mesh.vertices(f, Eigen::all)), Faces{{0, 1, 2}}});
    if (planes.rows() == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(hull.source[f[k]], hull.source[f[(k + 1) % 3]]);
      if (a != b) facets_.push_back({a, b, planes.row(0)});
    }
  }
  std::stable_sort(facets_.begin(), facets_.end(),
                   [](const Facet& x, const Facet& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
}

Hollows::Roof Hollows::roof(int a, int b) const {
  const auto [low, high] = std::minmax(a, b);
  Roof roof{.planes = {}, .a = part_.positions.row(a), .b = part_.positions.row(b)};
  auto facet = std::lower_bound(facets_.begin(), facets_.end(), std::pair(low, high),
                                [](const Facet& f, const auto& ends) { return std::pair(f.a, f.b) < ends; });
  for (; facet != facets_.end() && facet->a == low && facet->b == high; ++facet) roof.planes.push_back(facet->plane);
  return roof;
}

double Hollows::depth(int v, const Roof& roof, Sides sides) const {
  if (roof.planes.empty()) return 0;
  const Point p = part_.positions.row(v), along = roof.b - roof.a;
  const double t = (p - roof.a).dot(along) / along.squaredNorm();
  if (!(t > 0 && t < 1)) return 0;
  const Point up = roof.a + t * along - p;
  const double facing = up.dot(normals_.row(v));
  if (sides == Sides::outer && facing <= kLeastFacing * up.norm()) return 0;
  double depth = std::numeric_limits<double>::infinity();
  for (const Plane& plane : roof.planes) depth = std::min(depth, plane[3] - p.dot(plane.head<3>()));
  return std::max(0.0, depth);
}

double Hollows::depth(int v, int a, int b, Sides sides) const { return depth(v, roof(a, b), sides); }

Hollows::Bottom Hollows::descend(int v, int a, int b, Sides sides) const {
  const Roof above = roof(a, b);
  Bottom bottom{v, depth(v, above, sides)};
  std::vector<char> seen(static_cast<std::size_t>(part_.size()), 0);
  std::vector<int> ball;
  for (;;) {
    const int centre = bottom.vertex;
    Bottom best = bottom;
    ball.assign(1, centre);
    seen[centre] = 1;
    for (std::size_t i = 0; i < ball.size(); ++i) {
      for (int k = part_.first[ball[i]]; k < part_.first[ball[i] + 1]; ++k) {
        const int w = part_.neighbour[k];
        if (seen[w]) continue;
        const bool near = (part_.positions.row(w) - part_.positions.row(centre)).norm() <= step_;
        if (!near && i > 0) continue;
        const double deep = depth(w, above, sides);
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
  std::vector<int> path = search.path_to(a), rest = search.path_to(b);
  if (path.empty() || rest.empty()) return {};
  std::reverse(path.begin(), path.end());
  path.insert(path.end(), rest.begin() + 1, rest.end());
  return path;
}

}  // namespace partwise
