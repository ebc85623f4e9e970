#include "bench/check/hull.h"

#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace partwise::bench {
namespace {

bool coplanar(const std::vector<Point>& points) {
  if (points.size() < 4) return true;
  const Point& a = points[0];
  const auto b = std::ranges::find_if(points, [&](const Point& p) { return p != a; });
  if (b == points.end()) return true;
  const auto c = std::ranges::find_if(points, [&](const Point& p) { return !CGAL::collinear(a, *b, p); });
  if (c == points.end()) return true;
  return std::ranges::all_of(points, [&](const Point& p) { return CGAL::coplanar(a, *b, *c, p); });
}

}  // namespace

Hull::Hull(const Shape& written) : vertices_(written.vertices), written_closed_(written.closed()) {
  if (coplanar(vertices_)) return;
  using Surface = CGAL::Surface_mesh<Point>;
  Surface hull;
  CGAL::convex_hull_3(vertices_.begin(), vertices_.end(), hull);
  double area = 0;
  for (const Surface::Face_index face : hull.faces()) {
    Point corners[3];
    int k = 0;
    for (const Surface::Vertex_index v : hull.vertices_around_face(hull.halfedge(face))) corners[k++] = hull.point(v);
    facets_.emplace_back(corners[0], corners[1], corners[2]);
    area += std::sqrt(facets_.back().squared_area());
  }
  Vector sum(0, 0, 0);
  for (const Point& p : vertices_) sum += p - CGAL::ORIGIN;
  centre_ = CGAL::ORIGIN + sum / static_cast<double>(vertices_.size());
  for (const Point& p : vertices_) size_ = std::max(size_, std::sqrt((p - centre_).squared_length()));
  for (const Triangle& facet : facets_) {
    volume_ += CGAL::determinant(facet[0] - centre_, facet[1] - centre_, facet[2] - centre_) / 6;
    const Vector normal = CGAL::cross_product(facet[1] - facet[0], facet[2] - facet[0]);
    const double length = std::sqrt(normal.squared_length());
    if (length == 0) continue;
    Plane plane{normal.x() / length, normal.y() / length, normal.z() / length,
                -std::numeric_limits<double>::infinity()};
    // The support of the vertices rather than a corner: the plane of a needle may be tilted by rounding.
    for (const Point& p : vertices_)
      plane.offset = std::max(plane.offset, plane.x * p.x() + plane.y * p.y() + plane.z * p.z());
    planes_.push_back(plane);
  }
  written_dent_ = (volume_ - written.signed_volume()) / area;
}

double Hull::excess(const Point& p, const Vector& half) const {
  if (flat()) return std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
  for (const Plane& h : planes_)
    largest = std::max(largest, h.x * p.x() + h.y * p.y() + h.z * p.z() - h.offset + std::abs(h.x) * half.x() +
                                    std::abs(h.y) * half.y() + std::abs(h.z) * half.z());
  return largest;
}

double Hull::outside(const Point& p) const {
  if (!flat() && excess(p, Vector(0, 0, 0)) < -1e-9 * size_) return 0;
  const bool beyond = std::ranges::any_of(facets_, [&](const Triangle& facet) {
    return CGAL::orientation(facet[0], facet[1], facet[2], p) == CGAL::POSITIVE;
  });
  if (!flat() && !beyond) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& facet : facets_) nearest = std::min(nearest, CGAL::squared_distance(p, facet));
  return std::sqrt(nearest);
}

std::optional<Interval> Hull::clip(const Point& p, const Point& q) const {
  if (flat()) return std::nullopt;
  const Vector d = q - p;
  Interval t{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Plane& h : planes_) {
    const double slope = h.x * d.x() + h.y * d.y() + h.z * d.z();
    const double height = h.x * p.x() + h.y * p.y() + h.z * p.z() - h.offset;
    if (slope > 0) t.second = std::min(t.second, -height / slope);
    if (slope < 0) t.first = std::max(t.first, -height / slope);
    if (slope == 0 && height > 0) return std::nullopt;
  }
  if (t.first >= t.second) return std::nullopt;
  return t;
}

}  // namespace partwise::bench
