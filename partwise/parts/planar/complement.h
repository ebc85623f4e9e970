// What lies outside a region and shapes it: pockets and holes, decomposed in turn (Liu 2017, section 2.3.3.1, Algorithm
// 2), the hierarchy of their bridges, the concavity of vertices in it, and the intolerable features.
//
// A pocket deeper than the tolerance is decomposed as a region of its own; the cuts are bridges of the region. From the
// bridge on the hull they form a tree: each chamber, a nearly convex part of the pocket, hangs below the bridge through
// which it is entered. A hole that is nearly convex hangs below the pseudo bridge between its antipodal corners; one
// that is not is rooted at the cut that makes the tree least deep, and of those the one with the least concavity.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/region.h"

namespace partwise {

struct Chamber {
  int bridge = 0;  // in the hierarchy
  IndexRing ring;  // counter-clockwise; the first two corners are the ends of the bridge, unless it is a pseudo bridge
  int hole = -1;   // of the region; -1: a pocket of the outer ring
};

struct VertexConcavity {
  double value = 0;           // by the hierarchy, and at least the distance to the bridge on the hull
  std::vector<int> chambers;  // ascending
};

struct Complement {
  BridgeHierarchy hierarchy;
  std::vector<Chamber> chambers;
  std::unordered_map<int, VertexConcavity> vertices;  // of chambers
  std::vector<bool> noise;                            // a hole each: nowhere deeper than the tolerance
  std::unordered_map<int, double> features;           // intolerable vertices, with their concavity
  std::vector<IndexRing> simplified;  // outer ring, then the holes that are no noise, without what is neither on the
                                      // hull nor a feature
  double depth = 0;                   // region_depth
};

// Decomposes a simple region (no holes) into nearly convex ones.
using DecomposeRegion = std::function<std::vector<Region>(const Region&)>;

Complement measure_complement(std::span<const Point2> points, const Region& region, double tolerance,
                              const DecomposeRegion& decompose);

}  // namespace partwise
