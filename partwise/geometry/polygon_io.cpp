#include "partwise/geometry/polygon_io.h"

#include <fmt/format.h>

#include <iterator>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

void append_ring(std::string& text, const Ring& ring) {
  text += '[';
  for (Eigen::Index i = 0; i <= ring.rows(); ++i) {
    const auto corner = ring.row(i % ring.rows());
    fmt::format_to(std::back_inserter(text), "{}[{},{}]", i > 0 ? "," : "", corner.x(), corner.y());
  }
  text += ']';
}

void check_finite(const Polygons& polygons, const std::string& place) {
  for (const Polygon& polygon : polygons) {
    partwise::check_finite(polygon.outer, place);
    for (const Ring& hole : polygon.holes) partwise::check_finite(hole, place);
  }
}

Polygons read_by_ending(const std::filesystem::path& path, const PolygonReadSettings& settings) {
  const std::string file = path.string(), ending = path.extension().string();
  const auto is = [&](std::string_view name) { return equals_ignoring_case(ending, name); };
  if (!is(".poly") && !is(".wkt") && !is(".geojson") && !is(".json") && !is(".svg")) {
    throw InputError(file,
                     ending.empty() ? "has no ending that names a polygon format"
                                    : fmt::format("{} is not the ending of a polygon format", shown(ending)),
                     "use .poly, .svg, .geojson, .json or .wkt");
  }
  const std::string bytes = read_bytes(path);
  if (is(".poly")) return read_poly(file, bytes, settings.lenient);
  if (is(".wkt")) return read_wkt(file, bytes);
  if (is(".svg")) return read_svg(file, bytes, settings.flattening);
  return read_geojson(file, bytes);
}

}  // namespace

void check_finite(const Ring& ring, const std::string& place) {
  // Squares of coordinates must not overflow either.
  if (!ring.allFinite() || (ring.size() > 0 && ring.cwiseAbs().maxCoeff() > 1e150)) {
    throw InputError(place, "a coordinate is not finite or too large", "correct or remove it");
  }
}

Ring ring_of(std::span<const Eigen::Vector2d> corners) {
  Ring ring(static_cast<Eigen::Index>(corners.size()), 2);
  for (std::size_t i = 0; i < corners.size(); ++i) ring.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
  return ring;
}

PolygonFile valid_polygons(Polygons polygons, bool repair, const std::string& place) {
  check_finite(polygons, place);
  normalise(polygons);
  if (polygons.empty()) throw InputError(place, "encloses nothing", "give at least one polygon");
  PolygonFile result{std::move(polygons), {}};
  if (const auto fault = find_fault(result.polygons)) {
    result.repaired = fmt::format("{} near ({:.9g}, {:.9g})", fault->what, fault->where.x(), fault->where.y());
    if (!repair) throw InputError(place, result.repaired, "draw it without, or let it be repaired");
    result.polygons = repair_polygons(result.polygons, place);
  }
  return result;
}

PolygonFile read_polygons(const std::filesystem::path& path, const PolygonReadSettings& settings) {
  return valid_polygons(read_by_ending(path, settings), settings.repair, path.string());
}

Polygons read_parts(const std::filesystem::path& path, const PolygonReadSettings& settings) {
  Polygons polygons = read_by_ending(path, settings);
  check_finite(polygons, path.string());
  normalise(polygons);
  return polygons;
}

void write_geojson(const std::filesystem::path& path, std::span<const Polygon> polygons) {
  std::string text = "{\"type\":\"FeatureCollection\",\"features\":[";
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    fmt::format_to(std::back_inserter(text),
                   "{}\n{{\"type\":\"Feature\",\"properties\":{{\"part\":{}}},\"geometry\":{{\"type\":\"Polygon\","
                   "\"coordinates\":[",
                   i > 0 ? "," : "", i);
    append_ring(text, polygons[i].outer);
    for (const Ring& hole : polygons[i].holes) {
      text += ',';
      append_ring(text, hole);
    }
    text += "]}}";
  }
  write_file(path, text + "\n]}\n");
}

}  // namespace partwise
