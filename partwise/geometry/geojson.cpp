// GeoJSON (RFC 7946): the polygons of whatever object the file holds.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

using Json = nlohmann::json;

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  void object(const Json& json, int depth = 0) {
    const std::string type = json.is_object() && json.contains("type") && json["type"].is_string()
                                 ? json["type"].get<std::string>()
                                 : std::string();
    if (type.empty()) fail("holds a value that is no GeoJSON object");
    if (depth > 100) fail("nests more than 100 objects");
    if (type == "FeatureCollection" || type == "GeometryCollection") {
      for (const Json& member : array(json, type == "FeatureCollection" ? "features" : "geometries")) {
        object(member, depth + 1);
      }
    } else if (type == "Feature") {
      if (json.contains("geometry") && !json["geometry"].is_null()) object(json["geometry"], depth + 1);
    } else if (type == "Polygon") {
      polygon(array(json, "coordinates"));
    } else if (type == "MultiPolygon") {
      for (const Json& member : array(json, "coordinates")) polygon(member);
    }
  }

  Polygons polygons;

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(file_, problem, "give valid GeoJSON"); }

  const Json& array(const Json& json, const char* name) const {
    if (!json.contains(name) || !json[name].is_array()) fail(fmt::format("an object lacks the list \"{}\"", name));
    return json[name];
  }

  void polygon(const Json& rings) {
    if (!rings.is_array()) fail(fmt::format("polygon {} has no list of rings", polygons.size()));
    Polygon result;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      (r == 0 ? result.outer : result.holes.emplace_back()) = ring(rings[r]);
    }
    if (!rings.empty()) polygons.push_back(std::move(result));
  }

  Ring ring(const Json& corners) const {
    if (!corners.is_array()) fail(fmt::format("a ring of polygon {} is no list", polygons.size()));
    Ring result(static_cast<Eigen::Index>(corners.size()), 2);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Json& corner = corners[i];
      if (!corner.is_array() || corner.size() < 2 || !corner[0].is_number() || !corner[1].is_number()) {
        fail(fmt::format("corner {} of a ring of polygon {} is no pair of numbers", i, polygons.size()));
      }
      result.row(static_cast<Eigen::Index>(i)) << corner[0].get<double>(), corner[1].get<double>();
    }
    return result;
  }

  std::string file_;
};

}  // namespace

Polygons read_geojson(const std::string& file, std::string_view bytes) {
  // The parser of the library does not recurse, but destroying and walking what it made would.
  int depth = 0;
  for (char c : bytes) {
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (depth > 1000) throw InputError(file, "nests more than 1000 brackets", "give valid GeoJSON");
  }
  Json json;
  try {
    json = Json::parse(bytes);
  } catch (const Json::exception& error) {
    std::string_view reason = error.what();
    const std::size_t name_end = reason.find("] ");  // the name of the exception stands in brackets
    if (name_end != std::string_view::npos) reason.remove_prefix(name_end + 2);
    throw InputError(file, fmt::format("is not JSON ({})", shown_reason(reason)), "give valid GeoJSON");
  }
  Reader reader(file);
  reader.object(json);
  return std::move(reader.polygons);
}

}  // namespace partwise
