// Footprints of buildings from GeoJSON (RFC 7946, degrees) in metres: x = R cos(lat0) (lon - lon0), y = R (lat - lat0),
// with R = 6371008.8 m and (lon0, lat0) the centre of the bounding box of the file. x points east, y north.
//
// Each polygon of the file is a footprint, made valid by itself; what encloses nothing is left out. With a limit, the
// footprints nearest to the centre stay: by the distance of their boundary, 0 for those around it, of equally near ones
// those that come first. Errors: InputError for a file that cannot be read or holds no footprint.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/geometry/polygon.h"

namespace partwise {

struct City {
  std::vector<Polygons> footprints;  // in the order of the file
  Eigen::Vector2d centre;            // degrees, longitude and latitude
};

City read_city(const std::filesystem::path& path, int limit = 0);

}  // namespace partwise
