// Judges a decomposition in the plane without the code that made it: tiling by GEOS, tolerance by definition.
//
//   outline_check SHAPE PARTS.geojson [--lenient]
//
// Prints one JSON object. Areas are shares of the shape's: area_error (of the sum of the parts), outside and missing
// (by GEOS's overlay), overlap. foreign: corners of parts that are no corners of the shape. invalid: parts that GEOS
// rejects. depth: the largest distance of a corner of any part to the bridge over it, or of a hole's corner to the
// segment between the hole's corners farthest apart, in units of the shape.
#include <fmt/format.h>
#include <geos_c.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "partwise/parts/planar/read_shape.h"

namespace {

using partwise::Polygon;
using partwise::Polygons;
using partwise::Ring;
using Point = Eigen::RowVector2d;

struct Destroy {
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy(geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

GEOSCoordSequence* sequence(const Ring& ring) {
  const auto n = static_cast<unsigned>(ring.rows());
  GEOSCoordSequence* result = GEOSCoordSeq_create(n + 1, 2);
  for (unsigned i = 0; i <= n; ++i) GEOSCoordSeq_setXY(result, i, ring(i % n, 0), ring(i % n, 1));
  return result;
}

GEOSGeometry* geometry(const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(GEOSGeom_createLinearRing(sequence(hole)));
  return GEOSGeom_createPolygon(GEOSGeom_createLinearRing(sequence(polygon.outer)), holes.data(),
                                static_cast<unsigned>(holes.size()));
}

GEOSGeometry* collection(const Polygons& polygons, int type) {
  std::vector<GEOSGeometry*> members;
  for (const Polygon& polygon : polygons) members.push_back(geometry(polygon));
  return GEOSGeom_createCollection(type, members.data(), static_cast<unsigned>(members.size()));
}

double area(const Geometry& shape) {
  double result = NAN;
  if (shape) GEOSArea(shape.get(), &result);
  return result;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double t = ab.squaredNorm() > 0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0;
  return (p - a - t * ab).norm();
}

double outer_depth(const Ring& ring) {
  // Corners of GEOS's hull, found again along the ring, cut it into chains; each is measured to its own chord.
  const Geometry line(GEOSGeom_createLinearRing(sequence(ring))), hull(GEOSConvexHull(line.get()));
  std::set<std::pair<double, double>> corners;
  const GEOSCoordSequence* points = GEOSGeom_getCoordSeq(GEOSGetExteriorRing(hull.get()));
  unsigned count = 0;
  GEOSCoordSeq_getSize(points, &count);
  for (unsigned i = 0; i < count; ++i) {
    double x = 0, y = 0;
    GEOSCoordSeq_getXY(points, i, &x, &y);
    corners.insert({x, y});
  }
  const Eigen::Index n = ring.rows();
  std::vector<Eigen::Index> on;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (corners.contains({ring(i, 0), ring(i, 1)})) on.push_back(i);
  }
  double depth = 0;
  for (std::size_t k = 0; k < on.size(); ++k) {
    const Eigen::Index from = on[k], to = k + 1 < on.size() ? on[k + 1] : on[0] + n;
    for (Eigen::Index i = from + 1; i < to; ++i) {
      depth = std::max(depth, distance(ring.row(i % n), ring.row(from), ring.row(to % n)));
    }
  }
  return depth;
}

// Of several farthest pairs (a square has two) the one that serves the hole best.
double hole_depth(const Ring& ring) {
  double farthest = 0;
  for (Eigen::Index i = 0; i < ring.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) farthest = std::max(farthest, (ring.row(i) - ring.row(j)).norm());
  }
  double least = farthest;
  for (Eigen::Index i = 0; i < ring.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if ((ring.row(i) - ring.row(j)).norm() < farthest * (1 - 1e-9)) continue;
      double depth = 0;
      for (Eigen::Index k = 0; k < ring.rows(); ++k) {
        depth = std::max(depth, distance(ring.row(k), ring.row(i), ring.row(j)));
      }
      least = std::min(least, depth);
    }
  }
  return least;
}

nlohmann::ordered_json judge(const Polygons& shape, const Polygons& parts) {
  initGEOS(nullptr, nullptr);
  std::set<std::pair<double, double>> corners;
  const auto each_ring = [](const Polygons& polygons, const auto& visit) {
    for (const Polygon& polygon : polygons) {
      visit(polygon.outer);
      for (const Ring& hole : polygon.holes) visit(hole);
    }
  };
  each_ring(shape, [&](const Ring& ring) {
    for (Eigen::Index i = 0; i < ring.rows(); ++i) corners.insert({ring(i, 0), ring(i, 1)});
  });
  int foreign = 0, invalid = 0;
  each_ring(parts, [&](const Ring& ring) {
    for (Eigen::Index i = 0; i < ring.rows(); ++i) foreign += corners.contains({ring(i, 0), ring(i, 1)}) ? 0 : 1;
  });
  double sum = 0, depth = 0;
  for (const Polygon& part : parts) {
    const Geometry one(geometry(part));
    invalid += GEOSisValid(one.get()) == 1 ? 0 : 1;
    sum += area(one);
    depth = std::max(depth, outer_depth(part.outer));
    for (const Ring& hole : part.holes) depth = std::max(depth, hole_depth(hole));
  }
  const Geometry whole(collection(shape, GEOS_MULTIPOLYGON)), all(collection(parts, GEOS_GEOMETRYCOLLECTION));
  const Geometry joined(GEOSUnaryUnion(all.get()));
  const double size = area(whole);
  nlohmann::ordered_json result;
  result["parts"] = parts.size();
  result["area_error"] = std::abs(sum - size) / size;
  result["outside"] = area(Geometry(GEOSDifference(joined.get(), whole.get()))) / size;
  result["missing"] = area(Geometry(GEOSDifference(whole.get(), joined.get()))) / size;
  result["overlap"] = (sum - area(joined)) / size;
  result["foreign"] = foreign;
  result["invalid"] = invalid;
  result["depth"] = depth;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Judges a decomposition in the plane.", "outline_check");
  std::string shape, parts;
  partwise::PolygonReadSettings reading;
  program.add_option("SHAPE", shape)->required();
  program.add_option("PARTS", parts)->required();
  program.add_flag("--lenient", reading.lenient);
  CLI11_PARSE(program, argc, argv);
  try {
    const Polygons given = partwise::read_shape(shape, reading).polygons;
    fmt::print("{}\n", judge(given, partwise::read_parts(parts)).dump());
  } catch (const std::exception& error) {
    fmt::print(stderr, "outline_check: {}\n", error.what());
    return 1;
  }
  return 0;
}
