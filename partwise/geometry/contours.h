// The outlines of what is above a level in a grid of samples, at sub-pixel accuracy: marching squares (Lorensen, Cline
// 1987, in the plane) with crossings interpolated along the grid's lines. Saddles are decided by the mean of their four
// samples, as the bilinear patch would near its centre. Islands and holes nest.
//
// Sample (column i, row j) sits at (i + 1/2, j + 1/2): pixel coordinates, x right, y down. Beyond the grid samples
// are 0, and so are those that are not finite: a full grid is closed along the border of its outer pixels. Crossings
// keep 1/1000 pixel from the samples, so that no ring touches itself.
#pragma once

#include <span>

#include "partwise/geometry/polygon.h"

namespace partwise {

// values: height x width, row by row; filled where above `level`. Errors: CheckFailed for a wrong number of values, or
// a level that is not above 0.
Polygons trace_contours(std::span<const float> values, int width, int height, float level = 0.5f);

}  // namespace partwise
