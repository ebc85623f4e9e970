// GEOS through its C interface, for the files of this room that need it; no public header sees it.
#pragma once

#include <geos_c.h>

#include <memory>
#include <span>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

// One GEOS context a call: contexts must not be shared between threads.
class Geos {
 public:
  Geos() : context_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(context_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  GEOSContextHandle_t context() const { return context_; }

  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;
  Geometry own(GEOSGeometry* geometry) const {
    PARTWISE_CHECK((geometry != nullptr), ==, true);
    return Geometry(geometry, Destroy{context_});
  }

  GEOSGeometry* ring(const Ring& corners) const {
    const auto count = static_cast<unsigned>(corners.rows());
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context_, count + 1, 2);
    for (unsigned i = 0; i <= count; ++i) {
      GEOSCoordSeq_setXY_r(context_, sequence, i, corners(i % count, 0), corners(i % count, 1));
    }
    return GEOSGeom_createLinearRing_r(context_, sequence);
  }

  Geometry collection(std::span<const Polygon> polygons) const {
    std::vector<GEOSGeometry*> members;
    for (const Polygon& polygon : polygons) {
      std::vector<GEOSGeometry*> holes;
      for (const Ring& hole : polygon.holes) holes.push_back(ring(hole));
      members.push_back(
          GEOSGeom_createPolygon_r(context_, ring(polygon.outer), holes.data(), static_cast<unsigned>(holes.size())));
    }
    return own(GEOSGeom_createCollection_r(context_, GEOS_MULTIPOLYGON, members.data(),
                                           static_cast<unsigned>(members.size())));
  }

  Ring corners(const GEOSGeometry* ring) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, ring);
    unsigned count = 0;
    GEOSCoordSeq_getSize_r(context_, sequence, &count);
    Ring result(count > 0 ? count - 1 : 0, 2);
    for (unsigned i = 0; i + 1 < count; ++i) {
      GEOSCoordSeq_getXY_r(context_, sequence, i, &result(i, 0), &result(i, 1));
    }
    return result;
  }

  void collect(const GEOSGeometry* geometry, Polygons& polygons) const {
    if (GEOSGeomTypeId_r(context_, geometry) == GEOS_POLYGON) {
      if (GEOSisEmpty_r(context_, geometry) == 1) return;
      Polygon polygon{corners(GEOSGetExteriorRing_r(context_, geometry)), {}};
      for (int i = 0; i < GEOSGetNumInteriorRings_r(context_, geometry); ++i) {
        polygon.holes.push_back(corners(GEOSGetInteriorRingN_r(context_, geometry, i)));
      }
      polygons.push_back(std::move(polygon));
    } else if (GEOSGeomTypeId_r(context_, geometry) >= GEOS_MULTIPOINT) {
      for (int i = 0; i < GEOSGetNumGeometries_r(context_, geometry); ++i) {
        collect(GEOSGetGeometryN_r(context_, geometry, i), polygons);
      }
    }
  }

 private:
  GEOSContextHandle_t context_;
};

}  // namespace partwise
