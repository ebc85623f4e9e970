// Whether polygons are valid (polygon.h says what that means), and how to make them so. By GEOS.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "partwise/geometry/polygon.h"

namespace partwise {

struct PolygonFault {
  std::string what;       // "self-intersection"
  Eigen::Vector2d where;  // near there
};

// The first fault that is found; nothing for valid polygons.
std::optional<PolygonFault> find_fault(std::span<const Polygon> polygons);

// The same area as valid polygons: what is enclosed stays filled, overlaps are joined, lines and points go.
// Errors: InputError (place, "the shape") when nothing with an area is left.
Polygons repair_polygons(const Polygons& polygons, const std::string& place);

}  // namespace partwise
