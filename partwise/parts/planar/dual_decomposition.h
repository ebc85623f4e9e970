// DUAL-DECOMP (Liu 2017, section 2.3.3, Algorithm 2): a region is cut at its intolerable features, which the
// decomposition of its complement shows, until every part is within the tolerance.
#pragma once

#include <span>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/parts/planar/region.h"

namespace partwise {

struct DualSettings {
  double tolerance = 0;  // units of the points
  double radius = 1;     // of the whole shape, the unit of cut lengths in scores
};

struct DualResult {
  std::vector<Region> parts;  // region_depth of each is at most the tolerance; they tile the region
  int unresolved = 0;         // features for which no resolver was found in the round that met them
};

// No new points: cuts run between corners of the region. Parts are in a fixed order.
DualResult dual_decomposition(std::span<const Point2> points, const Region& region, const DualSettings& settings,
                              const Progress& progress = {});

}  // namespace partwise
