// The promise of the `hull` measure, for a hull as it will be delivered: simplified from outside to the number of
// vertices that was asked for, it still stays within the tolerance of the solid.
#pragma once

#include "partwise/parts/solid/outside_distance.h"

namespace partwise {

class HullPromise {
 public:
  // max_vertices 0: hulls are delivered as they are. Lengths in units of the mesh that `outside` measures.
  HullPromise(OutsideDistance& outside, double tolerance, int max_vertices)
      : outside_(outside), tolerance_(tolerance), max_vertices_(max_vertices) {}

  // The hull as delivered.
  Mesh shape(const Mesh& hull) const;

  bool holds(const Mesh& hull) const { return outside_.within(ConvexBody(shape(hull)), tolerance_); }

  // How far the delivered hull reaches outside, and where.
  OutsideDistance::Reach reach(const Mesh& hull) const { return outside_.reach(ConvexBody(shape(hull))); }

  double tolerance() const { return tolerance_; }

 private:
  OutsideDistance& outside_;
  double tolerance_;
  int max_vertices_;
};

}  // namespace partwise
