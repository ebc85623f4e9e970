// Which pixels of a row, and which of a column, lie on one surface without a step between them. Internal.
//
// A line of pixels falls into runs. Two neighbours of a run differ, a pixel apart, by a step of inverse depth that lies
// among the two steps before and the two behind, give or take `tolerance`: on a plane all steps are equal, at a crease
// they pass from one to the other, and across the border of two surfaces they leap. Two, for sensors that repeat every
// row. None is beyond `steepest`.
#pragma once

#include <span>
#include <vector>

namespace partwise {

// All of inverse depth, 1/m.
struct RunLimits {
  double noise = 0;      // differences of single values that mean nothing
  double tolerance = 0;  // of steps, as a share of the inverse depth
  double steepest = 0;   // step, as a share of the inverse depth
  int widest_gap = 0;    // missing pixels within a run
};

struct Run {
  int first = 0, last = -1;  // pixels of the line, which are in the run themselves
};

// Of each pixel its run; empty where `inverse_depth` is 0, that is missing.
void surface_runs(std::span<const double> inverse_depth, const RunLimits& limits, std::span<Run> runs);

}  // namespace partwise
