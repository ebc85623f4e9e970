// The concavity polygon of a valley, and where to split the valley (Liu 2017, sections 2.4.3, 2.4.3.2, 2.4.4.1).
//
// A bridge (a, b) and the path beneath it are flattened: a path vertex p becomes (ap . ab / |ab|, d(p, bridge)) (2.6;
// the printed formula lacks the division, without which the polygon is stretched). In the flat polygon the bridge is
// the base from (0, 0) to (|ab|, 0) and the path a polyline above it. All lengths in the units of the points.
#pragma once

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/parts/planar/hierarchical_concavity.h"

namespace partwise {

// The path is a .. b, its ends included.
std::vector<Point2> flatten_valley(std::span<const Point> path);

// The concavity of each vertex of a flattened valley: the length of the shortest path inside the polygon to the base.
// A polyline that never turns back along the base sees it straight below every vertex, so that this is its height. One
// that turns back is measured by shortest paths; one that crosses itself, or bulges into the polygon by more than the
// tolerance, by hierarchical_concavity().
std::vector<double> valley_concavity(std::span<const Point2> valley, double tolerance);

// The concavity of the prefix v_0 .. v_k of the valley once it is split at v_k: the largest distance of its vertices to
// the edges of its hull that lie inside the polygon, which are those (v_i, v_j), i < j, met counter-clockwise (Lemma
// 1). It grows with k, but for vertices that a steeper edge comes closer to. O(k log k).
double prefix_concavity(std::span<const Point2> valley, std::size_t k);

// RC (2.8): the larger of the concavities of v_0 .. v_k and, from the other end, v_{n-1} .. v_k.
double residual_concavity(std::span<const Point2> valley, std::size_t k);

// Where to split a deep valley. V-shaped: first == second, the vertex of least residual concavity, which is below the
// tolerance. U-shaped: no vertex is; the first and last vertices that leave shallow sub-valleys at either end, moved to
// the vertices of least residual concavity of these sub-valleys. Ties go to the deeper vertex. O(n log^2 n).
struct ValleySeparators {
  std::size_t first = 0, second = 0;
  bool v_shaped() const { return first == second; }
};
ValleySeparators valley_separators(std::span<const Point2> valley, double tolerance);

}  // namespace partwise
