#include "bench/check/solid.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>

namespace partwise::bench {
namespace {

using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Crossing {
  double t;
  int turn;  // +1 into the solid, -1 out of it
};

}  // namespace

struct Solid::State {
  bool closed = false;
  double radius = 0;
  std::vector<Triangle> triangles;
  Tree tree;

  // Where pq crosses the surface, in no order; nothing when it touches an edge or ends on a face.
  std::optional<std::vector<Crossing>> crossings(const Point& p, const Point& q) const {
    std::vector<Primitive::Id> hits;
    tree.all_intersected_primitives(Kernel::Segment_3(p, q), std::back_inserter(hits));
    std::vector<Crossing> result;
    const Vector d = q - p;
    for (const auto& hit : hits) {
      const Triangle& t = *hit;
      for (int k = 0; k < 3; ++k)
        if (CGAL::coplanar(p, q, t[k], t[(k + 1) % 3])) return std::nullopt;
      const CGAL::Orientation side = CGAL::orientation(t[0], t[1], t[2], p);
      if (side == CGAL::COPLANAR || CGAL::coplanar(t[0], t[1], t[2], q)) return std::nullopt;
      const Vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
      const double at = (t[0] - p) * normal / (d * normal);
      result.push_back({std::clamp(at, 0.0, 1.0), side == CGAL::POSITIVE ? 1 : -1});
    }
    return result;
  }
};

Solid::Solid(const Shape& shape) {
  auto state = std::make_unique<State>();
  state->closed = shape.closed();
  std::vector<bool> used(shape.vertices.size());
  for (const auto& [a, b, c] : shape.faces) {
    used[a] = used[b] = used[c] = true;
    const Triangle triangle(shape.vertices[a], shape.vertices[b], shape.vertices[c]);
    if (!triangle.is_degenerate()) state->triangles.push_back(triangle);
  }
  if (state->triangles.empty()) throw std::runtime_error("the mesh has no face with an area");
  using SphereTraits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Point> points;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) points.push_back(shape.vertices[v]);
  CGAL::Min_sphere_of_spheres_d<SphereTraits> sphere(points.begin(), points.end());
  state->radius = CGAL::to_double(sphere.radius());
  state->tree.insert(state->triangles.cbegin(), state->triangles.cend());
  state->tree.build();
  state->tree.accelerate_distance_queries();
  state_ = std::move(state);
}

Solid::~Solid() = default;

bool Solid::closed() const { return state_->closed; }
double Solid::radius() const { return state_->radius; }
double Solid::distance(const Point& p) const { return std::sqrt(state_->tree.squared_distance(p)); }

bool Solid::inside(const Point& p) const {
  if (!state_->closed) return false;
  const CGAL::Bbox_3 box = state_->tree.bbox();
  if (!CGAL::do_overlap(box, p.bbox())) return false;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> tilt(-0.1, 0.1);
  for (int attempt = 0; attempt < 20; ++attempt) {  // leave by the nearest side of the box, a little aslant
    int axis = 0, way = 1;
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      if (box.max(k) - p[k] < nearest) nearest = box.max(k) - p[k], axis = k, way = 1;
      if (p[k] - box.min(k) < nearest) nearest = p[k] - box.min(k), axis = k, way = -1;
    }
    double step[3];
    for (int k = 0; k < 3; ++k) step[k] = k == axis ? way : tilt(random);
    const double length = nearest + 0.1 * state_->radius;
    const auto crossings = state_->crossings(p, p + length * Vector(step[0], step[1], step[2]));
    if (!crossings) continue;
    int winding = 0;
    for (const Crossing& crossing : *crossings) winding -= crossing.turn;
    return winding != 0;
  }
  return true;  // every segment from p starts on a face: p lies on the surface
}

std::optional<std::vector<Interval>> Solid::clip(const Point& p, const Point& q) const {
  auto crossings = state_->crossings(p, q);
  if (!crossings) return std::nullopt;
  std::ranges::sort(*crossings, {}, &Crossing::t);
  std::vector<Interval> intervals;
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings->size(); ++i) {
    winding += (*crossings)[i].turn;
    if (winding != 0) intervals.emplace_back((*crossings)[i].t, (*crossings)[i + 1].t);
  }
  return intervals;
}

}  // namespace partwise::bench
