// Whether two sets of convex ridges lie at the same places.
//
// A ridge is the convex hull of its vertices. Two ridges are as far apart as the Hausdorff distance of these hulls
// says: the farthest that a point of either lies from the other. Both maxima are attained at vertices.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise::bench {

using Ridge = std::vector<Point>;  // at least one point

// Distance of p from the convex hull of the points, 0 inside: Gilbert, Johnson, Keerthi 1988. To 1e-9 of the distances
// among them.
double distance_to_hull(const Point& p, const Ridge& points);

// How far the hull of a reaches out of the hull of b.
double reach_out(const Ridge& a, const Ridge& b);

struct RidgeMatch {
  std::vector<int> partner;  // of each ridge of a: a ridge of b, or -1
  int matched = 0;
};

// One to one, between ridges at most `tolerance` apart, as many pairs as there can be (augmenting paths).
RidgeMatch match_ridges(const std::vector<Ridge>& a, const std::vector<Ridge>& b, double tolerance);

}  // namespace partwise::bench
