// The continuously visible regions of all vertices, one after the other, in parallel.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/inner_visibility.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/surface_graph.h"

namespace partwise {

using UseRegion = std::function<void(int viewpoint, const std::vector<int>& region)>;

// Finds the region of every vertex (visible_region.h); `use` is called once each, from several threads. Returns the
// number of visibility tests.
std::uint64_t for_each_region(const SurfaceGraph& graph, const InnerVisibility& visibility, VisibilityMethod method,
                              const Progress& progress, const UseRegion& use);

}  // namespace partwise
