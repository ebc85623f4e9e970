// The solid that a mesh bounds, for distance and containment. CGAL's AABB tree with exact predicates.
//
// Inside a closed mesh is where its winding number is not 0, so that components that overlap count once. An open mesh
// bounds no solid: nothing is inside it. Faces whose corners are collinear are passed over.
#pragma once

#include <memory>
#include <optional>

#include "bench/check/hull.h"
#include "bench/check/shape.h"

namespace partwise::bench {

class Solid {
 public:
  explicit Solid(const Shape& shape);
  ~Solid();

  bool closed() const;
  double radius() const;                  // of the smallest sphere around the vertices that faces use
  double distance(const Point& p) const;  // to the surface
  bool inside(const Point& p) const;
  // Where the segment pq, whose ends lie outside, is inside, in order; nothing when it touches an edge, which a segment
  // drawn at random does with probability zero: draw another.
  std::optional<std::vector<Interval>> clip(const Point& p, const Point& q) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace partwise::bench
