// Hierarchical concavity: how deep a vertex of a pocket lies below the pocket's bridge when the pocket bends and has
// chambers of its own (Liu 2017, section 2.3.3.1, equations 2.1 and 2.2; Liu, Xi, Lien 2014).
//
// A bridge is a segment between two points of a shape's boundary through its outside; the pocket is the piece of the
// boundary beneath it. Bridges form a tree: a chamber that is reached through another bridge's pocket hangs below it.
// The concavity of a vertex is its distance to its own bridge plus the distances from each bridge to its parent.
// Units: those of the points.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/geometry/orientation.h"

namespace partwise {

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b);
double segment_distance(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

class BridgeHierarchy {
 public:
  // Adds a bridge below `parent` (-1: a root) and returns its index. Parents come before their children.
  int add(int parent, const Point2& a, const Point2& b);

  // Distance from p, a vertex of the pocket of `bridge`, up the tree to the root's bridge (2.1, 2.2).
  double concavity(int bridge, const Point2& p) const;

  int parent(int bridge) const { return nodes_[bridge].parent; }
  int size() const { return static_cast<int>(nodes_.size()); }

 private:
  struct Node {
    int parent;
    Point2 a, b;
    double to_root;  // sum of the distances between successive bridges up to the root
  };
  std::vector<Node> nodes_;
};

// The concavity of each vertex of a pocket given as a polyline: its bridge joins the first and the last point. Where
// the region between pocket and bridge is narrowed by a bulge of the boundary deeper than the tolerance, it is cut
// there by a bridge of its own, recursively. Self-intersecting polylines are welcome. O(n^2) at worst.
std::vector<double> hierarchical_concavity(std::span<const Point2> pocket, double tolerance);

}  // namespace partwise
