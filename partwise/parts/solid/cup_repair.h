// The repair for cups (Liu 2017, section 2.4.8): valleys that are led through the bottom of a hollow.
//
// The valley of a bridge across the mouth of a cup runs along the rim, for that is the shortest path, and shows nothing
// of the hollow. The text asks that a valley's deepest vertex be a local maximum of concavity, else to descend from it
// to one and to force the valley through that. It leaves open what the concavity of a vertex off the valley is. Here it
// is the depth below the bridge: the distance to the nearest of the hull's facets that meet there. A vertex of the rim
// has none, one inside a cup its distance to the mouth. Only vertices beneath the bridge count (whose foot on it is
// between its ends), and a walk goes only where the bridge is on the outer side of the surface, so that it leads down
// the inside of a cup and never down the outside.
//
// A part may be one skin of a wall: its valleys run on the hull too, but their deepest vertices are themselves deep
// below the bridge. They need no walk, only the question how much of that depth is air, and how much is wall.
//
// Lengths in the units of the part's positions.
#pragma once

#include <vector>

#include "partwise/geometry/surface_query.h"
#include "partwise/parts/solid/part_graph.h"
#include "partwise/parts/solid/part_hull.h"

namespace partwise {

struct CupRepair {
  bool on = false;
  bool two_sided = false;  // the surface has no outer side: an open mesh
};

// The hollows of a part below the edges of its hull. All const: threads may share it.
class Hollows {
 public:
  // A walk looks as far as `step` over flat places, as the lip of a cup is.
  Hollows(const PartGraph& part, const PartHull& hull, double step, bool two_sided);

  // Of local vertex v below the bridge (a, b), an edge of the hull; 0 where it is not beneath.
  double depth(int v, int a, int b) const;

  // How far from the bridge towards v, which is beneath it, there is air: the distance to the first surface; 0 if the
  // bridge is inside the solid there. `surface` is the whole solid's.
  double air(int v, int a, int b, const SurfaceQuery& surface) const;

  struct Bottom {
    int vertex;
    double depth;
  };
  // Where the walk from `v` ends: each step goes to the deepest vertex that hangs together with the last within a ball
  // of radius `step`, or is its neighbour, as long as that is deeper.
  Bottom descend(int v, int a, int b) const;

 private:
  using Plane = Eigen::RowVector4d;  // (n, d), n . x <= d inside the hull
  struct Facet {
    int a, b;  // local vertices, a < b
    Plane plane;
  };
  struct Bridge {
    Point a, b;
    std::vector<Plane> facets;
  };
  Bridge bridge(int a, int b) const;
  double depth(int v, const Bridge& bridge, bool facing) const;

  const PartGraph& part_;
  double step_;
  bool two_sided_;
  std::vector<Facet> facets_;  // by edge
  Vertices normals_;           // of the local vertices
};

// The shortest path from a to b by way of `via`: the shortest to it and the shortest from it. Empty if there is none.
std::vector<int> path_through(PathSearch& search, int a, int via, int b);

}  // namespace partwise
