// The repair for cups (Liu 2017, section 2.4.8): valleys that are led through the bottom of a hollow.
//
// The valley of a bridge across the mouth of a cup runs along the rim, for that is the shortest path, and shows nothing
// of the hollow. The text asks that the valley's deepest vertex be a local maximum of concavity, else to descend from it
// to one and to force the valley through that. It leaves open what concavity is away from a valley. Here: how far the
// vertex lies below the hull's facets at the bridge, the nearest of them, if the bridge is on the outer side of the
// surface there, else 0. The rim has 0 then, the inside of a cup its distance to the mouth, and the outside 0, so that
// no walk goes down there. Lengths in the units of the part's positions.
#pragma once

#include <utility>
#include <vector>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/part_graph.h"

namespace partwise {

struct CupRepair {
  bool on = false;
};

// The hollows of a part below the edges of its hull. Const and safe to share between threads.
class Hollows {
 public:
  // `hull` is that of part.positions; steps over flat places are as long as `step` allows.
  Hollows(const PartGraph& part, const ConvexHull& hull, double step);

  enum class Sides { outer, both };
  double depth(int v, int a, int b, Sides sides) const;  // of local vertex v below the bridge (a, b)

  struct Bottom {
    int vertex;
    double depth;
  };
  // Where the walk from `v` ends: each step goes to the deepest vertex that is joined to the last by links within a ball
  // of radius `step`, or to a neighbour, as long as that is deeper.
  Bottom descend(int v, int a, int b, Sides sides) const;

 private:
  using Plane = Eigen::Vector4d;  // (n, d), n . x <= d inside the hull
  struct Facet {
    int a, b;  // local vertices, a < b
    Plane plane;
  };
  // The facets at one bridge.
  struct Roof {
    std::vector<Plane> planes;
    Point a, b;
  };
  Roof roof(int a, int b) const;
  double depth(int v, const Roof& roof, Sides sides) const;

  const PartGraph& part_;
  double step_;
  std::vector<Facet> facets_;  // by edge
  Vertices normals_;           // of the local vertices
};

// The shortest path from a to b by way of `via`, empty if there is none.
std::vector<int> path_through(PathSearch& search, int a, int via, int b);

}  // namespace partwise
