// Convex hulls of points in space, by Qhull (Barber, Dobkin, Huhdanpaa 1996).
//
// The hull is a closed triangle mesh, counter-clockwise from outside, whose vertices are a subset of the points, in
// ascending order of their index. Coplanar facets are triangulated. Time O(n log n).
//
// Flat or thinner sets (all points within `minimum_thickness` of a plane) have no volume and physics engines refuse
// them, so they are thickened: every point is doubled, moved by minimum_thickness / 2 to either side along the plane's
// normal (for a line or a point also across). `thickened` says so. The hull then still encloses all points.
//
// Errors: InputError for no points at all.
#pragma once

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct ConvexHull {
  Mesh mesh;
  std::vector<int> source;  // for each hull vertex the index of the point that it is (thickened: was moved from)
  bool thickened = false;
  double volume = 0;
};

// minimum_thickness in model units, positive.
ConvexHull convex_hull(const Vertices& points, double minimum_thickness);

// The planes (n, d) of the facets with n . x <= d inside, n of unit length: one a facet of positive area. The whole
// hull lies inside every one, also those of slivers, which rounding may turn any way.
Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> hull_planes(const Mesh& hull);

}  // namespace partwise
