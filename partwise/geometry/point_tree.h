// Which of many fixed points lie in a convex body: a tree of boxes over the points (Bentley 1975), asked with the
// planes of the body. A plane that does not cut a box is settled for all points in it, so that a body of P planes
// around k of n points costs about P plus what lies along its surface, not P n.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

class PointTree {
 public:
  PointTree() = default;
  explicit PointTree(Vertices points);

  const Vertices& points() const { return points_; }
  Eigen::Index size() const { return points_.rows(); }
  Point operator[](Eigen::Index i) const { return points_.row(i); }

  // The points (rows) inside the convex hull or on it, in an order that depends on the points alone. Every facet's
  // plane must have the whole hull behind it.
  std::vector<int> inside(const Mesh& hull) const;

 private:
  struct Box {
    Point centre, half;
  };
  struct Query;

  void build(std::size_t node, int begin, int end);

  Vertices points_;
  std::vector<int> order_;  // points by the leaves of the tree
  std::vector<Box> boxes_;  // a complete binary tree: node k has the children 2 k + 1 and 2 k + 2
};

}  // namespace partwise
