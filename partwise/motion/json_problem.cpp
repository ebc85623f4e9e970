// Partwise's own problem files, .json: docs/problems.md has the fields.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/json_fields.h"
#include "partwise/geometry/extrude.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/motion/city.h"
#include "partwise/motion/problem_fields.h"
#include "partwise/motion/problem_formats.h"

namespace partwise {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

class ProblemReader {
 public:
  // Of the object at `place` of a file, which names files relative to `folder`.
  ProblemReader(std::filesystem::path path, std::string place, std::filesystem::path folder)
      : path_(std::move(path)), place_(std::move(place)), folder_(std::move(folder)) {}

  PlanningProblem read(const json& whole) {
    JsonFields fields = object("", whole);
    problem_.name = fields.has("name") ? fields.text("name") : path_.stem().string();
    fields.need("space");
    problem_.kind = fields.choice<SpaceKind>(
        "space", SpaceKind::se3,
        {{"plane", SpaceKind::plane}, {"space", SpaceKind::space}, {"se2", SpaceKind::se2}, {"se3", SpaceKind::se3}});
    if (fields.has("robot")) read_shapes(fields, "robot", true);
    if (problem_.robot.empty() && rotates()) {
      fields.refuse("robot", "is missing, but the space has rotations", "give a robot, or take plane or space");
    }
    read_shapes(fields, "obstacles", false);
    expect_obstacles(problem_, place_.empty() ? path_.string() : at(place_));
    read_bounds(fields);
    if (const json* queries = fields.find("queries")) read_queries(fields, *queries);
    fields.find("about");  // what people and programs note there
    fields.refuse_others();
    return std::move(problem_);
  }

 private:
  JsonFields object(const std::string& place, const json& value) const { return fields_at(within(place), value); }
  // `place` in the whole file.
  JsonFields fields_at(const std::string& place, const json& value) const {
    return {path_.string(), place, value, "docs/problems.md"};
  }
  std::string within(const std::string& place) const {
    return place_ + (place_.empty() || place.empty() ? "" : ".") + place;
  }
  std::string at(const std::string& place) const { return path_.string() + ": " + place; }
  bool planar() const { return is_planar(problem_.kind); }
  bool rotates() const { return problem_.kind == SpaceKind::se2 || problem_.kind == SpaceKind::se3; }

  static const json& list(const JsonFields& fields, const std::string& name, const json& value) {
    if (!value.is_array()) fields.refuse(name, "is not a list", "write [ ... ]");
    return value;
  }

  static Eigen::VectorXd numbers(const JsonFields& fields, const std::string& name, const json& value,
                                 std::size_t count) {
    bool fits = value.is_array() && value.size() == count;
    for (const json& each : value) fits = fits && each.is_number() && std::isfinite(each.get<double>());
    if (!fits) fields.refuse(name, fmt::format("is not a list of {} numbers", count), "write that many in brackets");
    Eigen::VectorXd result(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) result[static_cast<Eigen::Index>(i)] = value[i].get<double>();
    return result;
  }

  static Ring ring(const JsonFields& fields, const std::string& name, const json& value) {
    Ring corners(static_cast<Eigen::Index>(list(fields, name, value).size()), 2);
    if (corners.rows() < 3) fields.refuse(name, "has fewer than three corners", "write [[x, y], ...]");
    for (std::size_t i = 0; i < value.size(); ++i) {
      corners.row(static_cast<Eigen::Index>(i)) = numbers(fields, fmt::format("{}[{}]", name, i), value[i], 2);
    }
    return corners;
  }

  // Where a thing is: a position, and a turn by an angle about an axis.
  Eigen::Isometry3d pose(const std::string& place, const json& value) const {
    JsonFields fields = fields_at(place, value);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (const json* position = fields.find("position")) {
      pose.translation() = numbers(fields, "position", *position, 3);
    }
    Vector3d axis = Vector3d::UnitZ();
    if (const json* given = fields.find("axis")) axis = numbers(fields, "axis", *given, 3);
    if (axis.norm() < 1e-12) fields.refuse("axis", "has no length", "give it a direction");
    constexpr double turns = 36000;
    const double angle = fields.number("degrees", 0, -turns, turns) * std::numbers::pi / 180;
    pose.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    fields.refuse_others();
    return pose;
  }

  void read_shapes(JsonFields& fields, const std::string& name, bool is_robot) {
    const json& shapes = list(fields, name, fields.need(name));
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      JsonFields shape = object(fmt::format("{}[{}]", name, i), shapes[i]);
      const int kinds = shape.has("mesh") + shape.has("polygon") + shape.has("polygons") + shape.has("city");
      if (kinds != 1) shape.refuse("", "has not one of mesh, polygon, polygons and city", "give one of them");
      if (is_robot && shape.has("city")) shape.refuse("city", "is no robot", "give a mesh or polygons");
      shape.has("mesh") ? add_mesh(shape, is_robot) : add_polygons(shape, is_robot);
      shape.refuse_others();
    }
  }

  void add_mesh(JsonFields& shape, bool is_robot) {
    if (!is_robot && problem_.kind == SpaceKind::plane && problem_.robot.empty()) {
      shape.refuse("mesh", "cannot be an obstacle of a point in the plane", "give polygons, or a robot");
    }
    Mesh mesh = read_named_mesh(folder_, shape.text("mesh"), at(shape.place_of("mesh")));
    mesh.vertices *= shape.number("scale", 1, 1e-9, 1e9);
    if (const json* given = shape.find("pose")) move_mesh(mesh, pose(shape.place_of("pose"), *given));
    (is_robot ? problem_.robot : problem_.obstacles).push_back(std::move(mesh));
  }

  // The polygons of a shape, one an obstacle.
  std::vector<Polygons> polygons(JsonFields& shape) const {
    std::vector<Polygons> result;
    if (shape.has("city")) {
      return read_city(folder_ / shape.text("city"), shape.whole("limit", 0, 1, 1000000000)).footprints;
    }
    Polygons all;
    if (shape.has("polygons")) {
      all = read_polygons(folder_ / shape.text("polygons")).polygons;
    } else {
      Polygon polygon{ring(shape, "polygon", shape.need("polygon")), {}};
      if (const json* holes = shape.find("holes")) {
        for (std::size_t i = 0; i < list(shape, "holes", *holes).size(); ++i) {
          polygon.holes.push_back(ring(shape, fmt::format("holes[{}]", i), (*holes)[i]));
        }
      }
      all = valid_polygons({polygon}, false, at(shape.place_of("polygon"))).polygons;
    }
    for (Polygon& each : all) result.push_back({std::move(each)});
    return result;
  }

  // In the plane prisms of height 1 about z = 0, so that their distances are the polygons'; in space from 0 upward.
  void add_polygons(JsonFields& shape, bool is_robot) {
    std::vector<Polygons> given = polygons(shape);
    if (!planar()) shape.need("height");
    const double height = planar() ? 1 : shape.number("height", 1, 1e-9, 1e9), low = planar() ? -0.5 : 0;
    if (!is_robot && problem_.kind == SpaceKind::plane && problem_.robot.empty()) {
      for (Polygons& each : given) problem_.footprints.push_back(std::move(each));
      return;
    }
    for (const Polygons& each : given) {
      for (const Polygon& polygon : each) {
        (is_robot ? problem_.robot : problem_.obstacles).push_back(prism(polygon, low, low + height));
      }
    }
  }

  void read_bounds(JsonFields& fields) {
    const json* given = fields.find("bounds");
    const std::string place = at(within("bounds"));
    if (given == nullptr) {
      problem_.bounds = usual_bounds(problem_);
      expect_room(problem_, place);
      return;
    }
    JsonFields bounds = object("bounds", *given);
    const std::size_t axes = planar() ? 2 : 3;
    const auto corner = [&](const char* name) {
      Vector3d point = Vector3d::Zero();
      point.head(static_cast<Eigen::Index>(axes)) = numbers(bounds, name, bounds.need(name), axes);
      return point;
    };
    if (bounds.has("radius")) {
      const Vector3d centre = corner("centre");
      const double radius = bounds.number("radius", 1, 1e-9, 1e12);
      const Vector3d half(radius, radius, planar() ? 0 : radius);
      problem_.sphere = Sphere{centre.transpose(), radius};
      problem_.bounds = Eigen::AlignedBox3d(centre - half, centre + half);
    } else {
      const Vector3d low = corner("low");
      problem_.bounds = Eigen::AlignedBox3d(low, corner("high"));
    }
    problem_.bounds_hold_body = bounds.choice<bool>("hold", false, {{"origin", false}, {"body", true}});
    bounds.refuse_others();
    expect_room(problem_, place);
  }

  // A list of the space's coordinates, or a pose.
  Configuration configuration(const JsonFields& fields, const std::string& name, const json& value) const {
    if (value.is_object()) {
      const Eigen::Isometry3d there = pose(fields.place_of(name), value);
      return configuration_at(problem_.kind, there.translation(), Eigen::Quaterniond(there.linear()));
    }
    const auto count = static_cast<std::size_t>(coordinate_count(problem_.kind));
    const Eigen::VectorXd q = numbers(fields, name, value, count);
    return configuration_of(problem_.kind, {q.data(), count}, at(fields.place_of(name)));
  }

  void read_queries(const JsonFields& fields, const json& queries) {
    for (std::size_t i = 0; i < list(fields, "queries", queries).size(); ++i) {
      JsonFields query = object(fmt::format("queries[{}]", i), queries[i]);
      const auto end = [&](const char* name) {
        Configuration q = configuration(query, name, query.need(name));
        expect_within_bounds(problem_, q, at(query.place_of(name)), std::string("the ") + name);
        return q;
      };
      const Configuration start = end("start");
      problem_.queries.push_back({start, end("goal")});
      query.refuse_others();
    }
  }

  std::filesystem::path path_;
  std::string place_;
  std::filesystem::path folder_;
  PlanningProblem problem_;
};

}  // namespace

PlanningProblem read_json_problem(const std::filesystem::path& path) {
  return json_problem_at(read_json(path), path, "", path.parent_path());
}

PlanningProblem json_problem_at(const json& object, const std::filesystem::path& file, const std::string& place,
                                const std::filesystem::path& folder) {
  return ProblemReader(file, place, folder).read(object);
}

}  // namespace partwise
