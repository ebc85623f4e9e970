// Weak continuous visibility from one end (Liu 2017, section 2.2.4.3): what a vertex sees over shortest paths that are
// hidden from it for at most a threshold of their length. Mutual pairs of it are the weak kind.
#pragma once

#include <cstdint>

#include "partwise/base/progress.h"
#include "partwise/geometry/inner_visibility.h"
#include "partwise/parts/surface/surface_graph.h"
#include "partwise/parts/surface/visibility_matrix.h"

namespace partwise {

// Row p: the vertices q that p sees and whose path from p in the tree of shortest paths (Dijkstra 1959, along edges) is
// hidden from p for at most `threshold` (shares of R). The hidden length cannot fall along a path, so that nothing
// behind a vertex where it is too long is tested. Time O(n^2 log n).
VisibilityMatrix weak_regions(const SurfaceGraph& graph, const InnerVisibility& visibility, double threshold,
                              const Progress& progress, std::uint64_t& tests);

}  // namespace partwise
