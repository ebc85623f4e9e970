// Volumes of the hulls' union, of the solid and of the solid's share that no hull covers, by random lines: a jittered
// grid of parallel lines in a random direction, along each of which the intervals inside are found exactly. That is
// repeated in new directions until the standard error, taken from the repetitions, is small enough.
#pragma once

#include <cstdint>

#include "bench/check/hull.h"
#include "bench/check/solid.h"

namespace partwise::bench {

struct CoverageSettings {
  int lines = 64;           // along the longer side of a grid
  int repetitions_min = 8;  // directions
  int repetitions_max = 64;
  double relative_error = 1e-3;  // of the union's volume over the solid's (for an open mesh, of the union's volume)
  std::uint64_t seed = 1;
};

// Estimates and their standard errors. What needs a solid is not a number for an open mesh.
struct Coverage {
  double volume_union = 0, volume_union_error = 0;
  double volume_solid = 0;
  double ratio = 0, ratio_error = 0;
  double uncovered = 0, uncovered_error = 0;  // share of the solid
};

Coverage measure_coverage(const Solid& solid, const Shape& shape, const std::vector<Hull>& hulls,
                          const CoverageSettings& settings);

}  // namespace partwise::bench
