#include "partwise/parts/applications/cage_moves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/json_fields.h"

namespace partwise {
namespace {

using nlohmann::json;

constexpr double most = 1e300;

Point three_numbers(JsonFields& fields, const std::string& name) {
  const json& value = fields.need(name);
  Point result;
  if (!value.is_array() || value.size() != 3) fields.refuse(name, "is not three numbers", "write [x, y, z]");
  for (std::size_t k = 0; k < 3; ++k) {
    if (!value[k].is_number() || !(std::abs(value[k].get<double>()) <= most))
      fields.refuse(name, "is not three numbers", "write [x, y, z]");
    result[static_cast<Eigen::Index>(k)] = value[k].get<double>();
  }
  return result;
}

std::vector<int> listed_vertices(JsonFields& fields, int count) {
  const json& list = fields.need("vertices");
  if (!list.is_array() || list.empty()) fields.refuse("vertices", "is no list of numbers", "write [0, 7]");
  std::vector<int> result;
  for (const json& each : list) {
    if (!each.is_number_integer() || each.get<double>() < 0 || each.get<double>() >= count) {
      fields.refuse("vertices", fmt::format("holds {}, the cage has the vertices 0 to {}", each.dump(), count - 1),
                    "change it");
    }
    result.push_back(each.get<int>());
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<int> vertices_of(JsonFields& fields, const Vertices& rest) {
  if (fields.has("vertices") + fields.has("near") + fields.has("all") != 1)
    fields.refuse("", "names its vertices in no or more than one way", "give one of \"vertices\", \"near\", \"all\"");
  const int count = static_cast<int>(rest.rows());
  if (fields.has("vertices")) return listed_vertices(fields, count);
  std::vector<int> result(static_cast<std::size_t>(count));
  std::iota(result.begin(), result.end(), 0);
  if (fields.has("all")) {
    if (!fields.truth("all", false)) fields.refuse("all", "is not true", "leave it out, or write true");
    return result;
  }
  const Point centre = three_numbers(fields, "near");
  fields.need("within");
  const double radius = fields.number("within", 0, 0, most);
  std::erase_if(result, [&](int v) { return (rest.row(v) - centre).norm() > radius; });
  if (result.empty()) fields.refuse("within", "holds no vertex of the cage", "give a wider ball, or another place");
  return result;
}

Point scale_of(JsonFields& fields) {
  if (!fields.has("scale")) return Point::Ones();
  if (!fields.need("scale").is_array()) return Point::Constant(fields.number("scale", 1, -most, most));
  return three_numbers(fields, "scale");
}

Eigen::Matrix3d rotation_of(JsonFields& fields) {
  if (fields.has("rotate") != fields.has("degrees"))
    fields.refuse("", "has one of \"rotate\" and \"degrees\"", "give both, or none");
  if (!fields.has("rotate")) return Eigen::Matrix3d::Identity();
  const Point axis = three_numbers(fields, "rotate");
  const double degrees = fields.number("degrees", 0, -1e6, 1e6);
  if (!(axis.norm() > 0)) fields.refuse("rotate", "has no length", "give an axis such as [0, 1, 0]");
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized().transpose()).toRotationMatrix();
}

void apply(JsonFields& fields, const Vertices& rest, Vertices& vertices) {
  const std::vector<int> which = vertices_of(fields, rest);
  Point about = Point::Zero();
  for (const int v : which) about += vertices.row(v);
  about /= static_cast<double>(which.size());
  if (fields.has("about")) about = three_numbers(fields, "about");
  const Point scale = scale_of(fields);
  if ((scale.array() == 0).any()) fields.refuse("scale", "is 0", "a cage without volume holds nothing");
  const Eigen::Matrix3d rotation = rotation_of(fields);
  const Point move = fields.has("move") ? three_numbers(fields, "move") : Point(Point::Zero());
  fields.refuse_others();
  for (const int v : which) {
    const Point scaled = (vertices.row(v) - about).cwiseProduct(scale);
    vertices.row(v) = about + scaled * rotation.transpose() + move;
  }
}

}  // namespace

Vertices read_cage_moves(const std::filesystem::path& path, const Mesh& cage) {
  const std::string page = "docs/cage.md";
  const json whole = read_json(path);
  JsonFields fields(path.string(), "", whole, page);
  const json& handles = fields.need("handles");
  if (!handles.is_array()) fields.refuse("handles", "is no list", "write [ { ... } ]");
  fields.refuse_others();
  Vertices vertices = cage.vertices;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    JsonFields handle(path.string(), fmt::format("handles[{}]", h), handles[h], page);
    apply(handle, cage.vertices, vertices);
  }
  return vertices;
}

}  // namespace partwise
