// Bridges, valleys and convex ridges of a part (Liu 2017, sections 2.4.3 and 2.4.3.1, Algorithm 3).
//
// A bridge is an edge of the part's convex hull, its valley the shortest path on the part between its ends. A valley is
// deep when its concavity exceeds the tolerance. A convex ridge is a group of hull vertices joined by shallow valleys
// with no deep one among them: a protruding piece that is convex enough. A part with one ridge needs no cut.
//
// Bridges through the inside of the solid, which only bridge the openings that earlier cuts left, are no bridges: those
// at whose quarter points the whole surface winds round.
//
// A valley that runs on the hull itself has nothing beneath the hull to show: it goes round a flat opening, as the rim
// of a cup does round the mouth. Such rims do not count as concavity. They are cut where that helps (the outline of a
// flat plate), see valley_decomposition.h. With the repair for cups (cup_repair.h) a rim with a hollow beneath its
// bridge that is deeper than the tolerance is led through it and counts.
#pragma once

#include <span>
#include <vector>

#include "partwise/geometry/surface_query.h"
#include "partwise/parts/solid/concavity_polygon.h"
#include "partwise/parts/solid/cup_repair.h"
#include "partwise/parts/solid/part_graph.h"
#include "partwise/parts/solid/part_hull.h"

namespace partwise {

struct Valley {
  std::vector<int> path;        // local vertices, from one end of the bridge to the other
  std::vector<Point2> profile;  // the flattened path
  double concavity = 0;
  int deepest = -1;             // the local vertex of that concavity
  bool through_hollow = false;  // a rim once, until the repair for cups
  bool on_hull = false;         // deep, but no vertex is inside the hull by more than the depth of rims
};

struct Bridges {
  struct Shallow {
    int a, b;       // local vertices
    double length;  // of the valley
  };
  std::vector<Shallow> shallow;
  std::vector<Valley> deep;  // with the repair for cups also former rims
  std::vector<Valley> rims;  // deep and on the hull: the rim of a cup, the outline of a plate
  double concavity =
      0;  // largest of all but the rims; for shallow valleys that were only bounded, their bound counts if it is larger
};

// How deep inside the hull a rim's vertices may lie, of the tolerance: while parts are cut, and when they merge.
// Cutting at the rims of thin plates and limbs finds the natural pieces; merging may then leave flat bends that take in
// little air.
constexpr double kRimDepthCutting = 0.25, kRimDepthMerging = 0.5;

// All bridges of the part at a tolerance in model units. `surface` is the whole solid's.
Bridges find_bridges(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance,
                     const CupRepair& repair = {}, double rim_depth = kRimDepthCutting);

// Whether find_bridges() would find a deep valley other than rims; looks no further than the first.
bool has_deep_valley(const PartGraph& part, const PartHull& hull, const SurfaceQuery& surface, double tolerance,
                     const CupRepair& repair = {}, double rim_depth = kRimDepthCutting);

struct ConvexRidges {
  std::vector<std::vector<int>> members;  // hull vertices (local) of each ridge
  std::vector<int> of_vertex;             // ridge of each local vertex, -1 off the hull
};

ConvexRidges convex_ridges(const PartGraph& part, const Bridges& bridges);

}  // namespace partwise
