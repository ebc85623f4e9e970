#include "partwise/geometry/polygon_validity.h"

#include <algorithm>
#include <cctype>

#include "partwise/base/error.h"
#include "partwise/geometry/geos.h"

namespace partwise {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::optional<PolygonFault> find_fault(std::span<const Polygon> polygons) {
  const Geos geos;
  const auto shape = geos.collection(polygons);
  char* reason = nullptr;
  GEOSGeometry* location = nullptr;
  const char valid = GEOSisValidDetail_r(geos.context(), shape.get(), 0, &reason, &location);
  std::optional<PolygonFault> fault;
  if (valid != 1) {
    fault = PolygonFault{lower(reason ? reason : "not valid"), Eigen::Vector2d::Zero()};
    if (location) {
      GEOSGeomGetX_r(geos.context(), location, &fault->where.x());
      GEOSGeomGetY_r(geos.context(), location, &fault->where.y());
    }
  }
  if (reason) GEOSFree_r(geos.context(), reason);
  if (location) GEOSGeom_destroy_r(geos.context(), location);
  return fault;
}

Polygons repair_polygons(const Polygons& polygons, const std::string& place) {
  const Geos geos;
  const auto shape = geos.collection(polygons);
  GEOSMakeValidParams* settings = GEOSMakeValidParams_create_r(geos.context());
  GEOSMakeValidParams_setMethod_r(geos.context(), settings, GEOS_MAKE_VALID_STRUCTURE);
  GEOSMakeValidParams_setKeepCollapsed_r(geos.context(), settings, 0);
  GEOSGeometry* made = GEOSMakeValidWithParams_r(geos.context(), shape.get(), settings);
  GEOSMakeValidParams_destroy_r(geos.context(), settings);
  if (made == nullptr) throw InputError(place, "the polygons cannot be repaired", "draw them again without crossings");
  const auto valid = geos.own(made);
  Polygons result;
  geos.collect(valid.get(), result);
  normalise(result);
  if (result.empty()) throw InputError(place, "the shape has no area", "give polygons that enclose something");
  if (find_fault(result)) {  // where coordinates are as small as their rounding
    throw InputError(place, "the polygons cannot be repaired", "draw them again without crossings");
  }
  return result;
}

}  // namespace partwise
