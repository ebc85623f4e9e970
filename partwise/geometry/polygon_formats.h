// One reader a polygon format, behind polygon_io.h. They take the name of the file, for messages, and its bytes, and
// give polygons that need not be valid.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "partwise/geometry/polygon.h"

namespace partwise {

Polygons read_poly(const std::string& file, std::string_view bytes, bool lenient);
Polygons read_wkt(const std::string& file, const std::string& bytes);
Polygons read_geojson(const std::string& file, std::string_view bytes);
Polygons read_svg(const std::string& file, std::string_view bytes, double flattening);

// InputError at `place` for coordinates that are not finite, or too large to be multiplied.
void check_finite(const Ring& ring, const std::string& place);

// A ring of the corners collected so far.
Ring ring_of(std::span<const Eigen::Vector2d> corners);

}  // namespace partwise
