// How far the hulls stick out of the solid: the largest distance to the surface of any point of a hull that lies
// outside the solid. Twice: over all points of the hulls (`strict`), and over the points that lie in one hull only
// (`exposed`). For an open mesh, whose solid is empty, the largest distance of any such point.
//
// First by points drawn at random on and in the hulls; then by a search that cannot miss: each hull's box is halved
// again and again, the box with the largest upper bound first. Moving by a step changes the distance by at most that
// step, so a box of half diagonal h around c holds no distance above distance(c) + h; boxes that miss their hull, lie
// in the solid, or (for `exposed`) lie in another hull are dropped. What is found is attained by a point; what remains
// is an upper bound.
#pragma once

#include <cstdint>
#include <limits>

#include "bench/check/hull.h"
#include "bench/check/solid.h"

namespace partwise::bench {

struct ExposureSettings {
  int samples = 20000;  // at least; a quarter shared equally between the hulls, the rest by volume
  std::uint64_t seed = 1;
  double gap = 2e-3;                                        // R: bound - found at which the search ends,
  int boxes = 50000;                                        // or after so many boxes
  double limit = std::numeric_limits<double>::quiet_NaN();  // R: where found <= limit < bound, the search goes on until
  int boxes_to_decide = 500000;                             // bound <= limit, or after so many
};

struct Exposure {
  double sampled = 0;  // shares of R: by samples alone,
  double found = 0;    // by samples or search,
  double bound = 0;    // and above which there is none
  int hull = -1;       // where `found` was; -1 when nothing sticks out
  int boxes = 0;
};

struct Exposures {
  Exposure strict, exposed;
  int samples = 0;
};

// `limit` applies to `exposed`. Samples and search know nothing of each other: throws std::logic_error when a sample
// lies above the search's bound.
Exposures measure_exposure(const Solid& solid, const std::vector<Hull>& hulls, const ExposureSettings& settings);

}  // namespace partwise::bench
