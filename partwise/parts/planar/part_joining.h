// Fewer parts: neighbours become one while their union stays within the tolerance, least concave unions first. What is
// left has no cut that could be taken back.
#pragma once

#include <span>
#include <vector>

#include "partwise/parts/planar/region.h"

namespace partwise {

std::vector<Region> join_parts(std::span<const Point2> points, std::vector<Region> parts, double tolerance);

}  // namespace partwise
