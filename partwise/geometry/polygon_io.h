// Polygons with holes from and to files. The format is chosen by the ending, in any case of letters.
//
// Read: .poly (acd2d: chains marked "out" or "in", a hole belongs to the last "out" before it), .wkt (POLYGON,
// MULTIPOLYGON and collections of them), .geojson and .json (any object; what is no polygon is passed over), .svg
// (path, polygon and rect with their transforms and fill rules; whatever is drawn counts as filled, what is only
// defined does not). Coordinates are taken as they are: SVG's y points down.
//
// What comes out is valid (polygon.h). Faults are repaired: what is enclosed stays filled, overlaps are joined; the
// first one is reported with its place. With `repair` off it is refused instead.
//
// Curves in SVG become chords that leave them by at most `flattening`.
//
// Errors: InputError, one line, with file and line or place, for a file that cannot be read, is malformed, encloses
// nothing, or holds numbers that are not finite.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "partwise/geometry/polygon.h"

namespace partwise {

struct PolygonReadSettings {
  double flattening = 0;  // user units of the SVG file; 0: 1/2000 of the longer side of the drawing's box
  bool lenient = false;   // .poly: two numbers that lost the blank between them are read as two
  bool repair = true;
};

struct PolygonFile {
  Polygons polygons;
  std::string repaired;  // the first fault and its place; empty when there was none
};

PolygonFile read_polygons(const std::filesystem::path& path, const PolygonReadSettings& settings = {});

// The polygons of a file as they stand, which may overlap or share sides: the parts of a decomposition. Rings are
// turned as polygon.h says, nothing else is changed or checked.
Polygons read_parts(const std::filesystem::path& path, const PolygonReadSettings& settings = {});

// What read_polygons does once the rings are known: directions, validity, repair. `place` is named in messages.
PolygonFile valid_polygons(Polygons polygons, bool repair, const std::string& place);

// One Feature a polygon in a FeatureCollection, with its index as property "part". Shortest digits that read back as
// the same doubles. Atomic.
void write_geojson(const std::filesystem::path& path, std::span<const Polygon> polygons);

}  // namespace partwise
