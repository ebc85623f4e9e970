// Bridges and pockets of a ring (Liu 2017, section 2.3.2, definitions 1 and 2), straight from its convex hull.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "partwise/parts/planar/region.h"

namespace partwise {

// The pockets of a counter-clockwise ring: chains of its corners, of which the first and the last are the bridge's
// ends, on the hull, and the others lie strictly inside the hull.
std::vector<IndexRing> hull_pockets(std::span<const Point2> points, const IndexRing& ring);

// The largest distance of a corner of the chain to its bridge, the segment from its first to its last corner (2.1).
double pocket_depth(std::span<const Point2> points, const IndexRing& chain);

// The two corners farthest apart (rotating calipers: Shamos 1978), and the largest distance of any corner to the
// segment between them, which is the concavity of a nearly convex hole.
struct AntipodalPair {
  int a = 0, b = 0;
  double depth = 0;
};
AntipodalPair antipodal_pair(std::span<const Point2> points, const IndexRing& ring);

// The concavity by which a region is accepted: the depth of its deepest pocket, or of its deepest hole beneath the
// bridge between the hole's antipodal corners.
double region_depth(std::span<const Point2> points, const Region& region);

// The corners between the ends of a convex chain that an approximation has to keep, so that what it leaves out is
// nowhere farther than the tolerance from it: as few as can be, and of those the ones that leave the least error
// (section 2.3.3.2). Chains of more than 128 corners are thinned first, at a sixteenth of the tolerance. O(n^3) at
// worst.
std::vector<int> approximate_chain(std::span<const Point2> points, IndexRing chain, double tolerance);

}  // namespace partwise
