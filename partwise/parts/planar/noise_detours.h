// Cuts that were chosen with noise holes filled, led round them: a diagonal that meets noise holes becomes diagonals
// from hole to hole, as if it could pass through them, by the shortest way along a constrained Delaunay triangulation.
#pragma once

#include <span>
#include <vector>

#include "partwise/parts/planar/region.h"

namespace partwise {

// The regions that the diagonals make of this one. `noise`: a hole each. A diagonal without a way is left out.
std::vector<Region> split_region(std::span<const Point2> points, const Region& region, const std::vector<bool>& noise,
                                 std::span<const IndexEdge> diagonals);

// The same, split along every diagonal of the triangulation that ends at one of these vertices, or along all of them.
std::vector<Region> split_at(std::span<const Point2> points, const Region& region, std::span<const int> vertices);
std::vector<Region> split_everywhere(std::span<const Point2> points, const Region& region);

}  // namespace partwise
