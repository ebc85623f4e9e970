// A convex hull as the judge sees it: not the facets that were written, whose planes could be anything, but CGAL's hull
// of the vertices that were written; how far the two differ is one of the things judged.
#pragma once

#include <optional>
#include <utility>

#include "bench/check/shape.h"

namespace partwise::bench {

using Triangle = Kernel::Triangle_3;

// p + t (q - p) for t in [first, second].
using Interval = std::pair<double, double>;

class Hull {
 public:
  explicit Hull(const Shape& written);

  bool flat() const { return facets_.empty(); }  // no volume: all vertices in one plane
  double volume() const { return volume_; }
  const std::vector<Triangle>& facets() const { return facets_; }  // counter-clockwise from outside
  const std::vector<Point>& vertices() const { return vertices_; }
  Point centre() const { return centre_; }

  bool written_closed() const { return written_closed_; }
  // Volume that the written surface misses of the hull of its vertices, as a mean depth (over the hull's area).
  double written_dent() const { return written_dent_; }

  // Closed, to rounding; strictly: deeper than 1e-9 of the hull's size. Boxes by centre and half extents; `misses_box`
  // may be false for a box that misses the hull near an edge.
  bool contains(const Point& p) const { return excess(p, Vector(0, 0, 0)) <= 1e-12 * size_; }
  bool strictly_contains(const Point& p, const Vector& half = Vector(0, 0, 0)) const {
    return excess(p, half) < -1e-9 * size_;
  }
  bool misses_box(const Point& p, const Vector& half) const { return excess(p, -half) > 1e-12 * size_; }
  // Distance of p outside the hull, 0 inside: exact orientation predicates decide, so that 0 means inside.
  double outside(const Point& p) const;
  std::optional<Interval> clip(const Point& p, const Point& q) const;  // the whole line through p and q

 private:
  struct Plane {
    double x, y, z, offset;  // x, y, z of unit length; inside is where the product is at most the offset
  };
  // Largest over the planes of the height above it plus the support of a box of half extents `half`.
  double excess(const Point& p, const Vector& half) const;

  std::vector<Point> vertices_;
  std::vector<Triangle> facets_;
  std::vector<Plane> planes_;
  Point centre_{0, 0, 0};
  double volume_ = 0, size_ = 0, written_dent_ = 0;
  bool written_closed_ = false;
};

}  // namespace partwise::bench
