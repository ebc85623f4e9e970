// Shortest paths between corners of a polygon with holes that has been cut: the visibility graph, its nodes split where
// cuts end, so that no path slips through a corner from one side of a cut to the other.
//
// A node is a wedge: a corner with one of the sectors that sides and cuts leave of its inside. Two wedges are joined
// where their corners see each other through these sectors. Paths bend at wedges of half a turn or more only.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "partwise/parts/planar/region.h"

namespace bench {

using partwise::IndexEdge;
using partwise::Point2;

class WedgeGraph {
 public:
  // `cuts` are diagonals that cross neither each other nor a side, smaller index first.
  WedgeGraph(std::span<const Point2> points, const partwise::Region& region, const std::set<IndexEdge>& cuts);

  int size() const { return static_cast<int>(corner_.size()); }
  int corner(int node) const { return corner_[node]; }
  const std::vector<int>& neighbours(int node) const { return neighbours_[node]; }
  bool bends(int node) const { return bends_[node]; }
  std::vector<int> components() const;

  // From one node to all: lengths (infinite where there is none) and the node before.
  struct Paths {
    std::vector<double> length;
    std::vector<int> before;
  };
  Paths paths_from(int node) const;
  // The corners on the way, from the source to `node`.
  std::vector<int> path_to(const Paths& paths, int node) const;

 private:
  struct Spoke {
    double angle = 0;
    int end = 0, node = -1;  // the node of the sector that follows counter-clockwise; -1 outside
  };
  void add_spoke(int from, int to, bool inside_follows);
  void make_nodes();
  void join_along(int from, int to);  // on the left of a side or cut
  int node_towards(int from, int to) const;

  std::span<const Point2> points_;
  std::map<int, std::vector<Spoke>> spokes_;
  std::vector<int> corner_;
  std::vector<bool> bends_;
  std::vector<std::vector<int>> neighbours_;
};

}  // namespace bench
