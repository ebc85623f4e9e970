// Which pixels of a row, and which of a column, lie on one surface without a step between them. Internal.
//
// A line of pixels falls into runs. Two neighbours of a run differ, a pixel apart, by a step of inverse depth that lies
// among the two steps before and the two behind, give or take `tolerance`: on a plane all steps are equal, at a crease
// they pass from one to the other, and across the border of two surfaces they leap. Two, for sensors that repeat every
// row. None is beyond `steepest`.
#pragma once

#include <span>
#include <vector>

#include "partwise/imaging/image.h"

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

// 1/m, 0 where the depth is missing: 0 or less or not finite.
std::vector<double> inverse_depths(const Image& depth);

// Of each pixel its run; empty where `inverse_depth` is 0.
void surface_runs(std::span<const double> inverse_depth, const RunLimits& limits, std::span<Run> runs);

// Of each pixel the run in its row, counted in columns, and that in its column, counted in rows.
struct PictureRuns {
  std::vector<Run> rows, columns;
};
PictureRuns picture_runs(std::span<const double> inverse_depth, int width, int height, const RunLimits& in_rows,
                         const RunLimits& in_columns);

// Steps that a plane makes, slanted by at most this angle against the viewing direction; relief as high as a pixel is
// wide is tolerated.
RunLimits run_limits(double focal, double steepest_degrees);

}  // namespace partwise
