#include "problems.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/geometry/extrude.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/motion/city.h"

namespace partwise::python {
namespace {

const Choices<SpaceKind> spaces = {
    {"plane", SpaceKind::plane}, {"space", SpaceKind::space}, {"se2", SpaceKind::se2}, {"se3", SpaceKind::se3}};

Configuration configuration_in(const py::handle& given, SpaceKind kind, const std::string& name) {
  const int count = coordinate_count(kind);
  const DoubleArray numbers = real_array(given, name, {count}, fmt::format("of {} numbers", count).c_str());
  return configuration_of(kind, {numbers.data(), static_cast<std::size_t>(count)}, name);
}

MotionQuery pair_in(const py::handle& given, SpaceKind kind, const std::string& name) {
  if (!py::isinstance<py::sequence>(given) || py::isinstance<py::str>(given) || py::len(given) != 2) {
    throw InputError(name, "is no pair", "give (start, goal)");
  }
  const auto pair = py::reinterpret_borrow<py::sequence>(given);
  return {configuration_in(pair[0], kind, name + ".start"), configuration_in(pair[1], kind, name + ".goal")};
}

Eigen::AlignedBox3d bounds_in(const py::handle& given, SpaceKind kind) {
  const int axes = position_axes(kind);
  const DoubleArray corners = real_array(given, "bounds", {2, axes}, axes == 2 ? "2 x 2" : "2 x 3");
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  low.head(axes) = Eigen::Map<const Eigen::VectorXd>(corners.data(), axes);
  high.head(axes) = Eigen::Map<const Eigen::VectorXd>(corners.data() + axes, axes);
  return {low, high};
}

SharedProblem problem_of(const std::string& space, const py::object& obstacles, const py::object& robot,
                         const py::object& bounds, bool hold_body, const py::object& queries) {
  auto problem = std::make_shared<PlanningProblem>();
  problem->name = "problem";
  problem->kind = chosen("space", space, spaces);
  problem->robot = meshes_in(robot, "robot");
  if (py::isinstance<City>(obstacles)) {
    problem->footprints = obstacles.cast<const City&>().footprints;
  } else {
    problem->obstacles = meshes_in(obstacles, "obstacles");
  }
  problem->bounds = bounds.is_none() ? usual_bounds(*problem) : bounds_in(bounds, problem->kind);
  problem->bounds_hold_body = hold_body;
  for (const py::handle& each : list_in(queries, "queries", "a list of pairs (start, goal)")) {
    problem->queries.push_back(pair_in(each, problem->kind, fmt::format("queries[{}]", problem->queries.size())));
  }
  check_problem(*problem);
  return problem;
}

// Views of meshes that the problem holds, and which keep it alive.
py::list meshes_of(const SharedProblem& problem, std::vector<Mesh> PlanningProblem::*member) {
  py::list result;
  for (Mesh& mesh : (*problem).*member) result.append(SharedMesh(problem, &mesh));
  return result;
}

py::array bounds_of(const PlanningProblem& problem) {
  const int axes = position_axes(problem.kind);
  const Eigen::VectorXd low = problem.bounds.min().head(axes), high = problem.bounds.max().head(axes);
  return rows_out(std::vector{low, high}, axes);
}

py::array configuration_out(const Configuration& q) { return vector_out(std::vector<double>(q.begin(), q.end())); }

py::list queries_of(const PlanningProblem& problem) {
  py::list result;
  for (const MotionQuery& query : problem.queries) {
    result.append(py::make_tuple(configuration_out(query.start), configuration_out(query.goal)));
  }
  return result;
}

SharedProblem read_problem(const std::filesystem::path& path, const std::optional<std::filesystem::path>& robot,
                           const std::optional<std::filesystem::path>& queries) {
  const ProblemFiles files{.robot = robot.value_or(""), .query = queries.value_or("")};
  return long_call(
      [&](const Progress&) { return std::make_shared<PlanningProblem>(read_planning_problem(path, files)); });
}

py::list prisms(const py::object& shape, double low, double high) {
  const Polygons given = polygons_in(shape, "shape");
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) {
    throw InputError("low, high", "do not run upward", "give two finite numbers, the lower one first");
  }
  py::list result;
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const Polygon& polygon : valid_polygons({given[i]}, false, fmt::format("shape[{}]", i)).polygons) {
      result.append(mesh_out(prism(polygon, low, high)));
    }
  }
  return result;
}

}  // namespace

SharedProblem problem_in(const py::handle& given) {
  if (py::isinstance<PlanningProblem>(given)) return given.cast<SharedProblem>();
  throw InputError("problem", "is no problem", "give a partwise.Problem, as read_problem() reads it");
}

MotionQuery query_in(const py::handle& given, const PlanningProblem& problem) {
  if (PyIndex_Check(given.ptr()) && !py::isinstance<py::array>(given)) {
    const auto number = py::int_(py::reinterpret_borrow<py::object>(given)).cast<long long>();
    if (number >= 0 && number < std::ssize(problem.queries)) return problem.queries[static_cast<std::size_t>(number)];
    throw InputError("query", fmt::format("is {}, the problem has {}", number, problem.queries.size()),
                     "count from 0, or give (start, goal)");
  }
  const MotionQuery query = pair_in(given, problem.kind, "query");
  for (const auto& [q, name] : {std::pair(query.start, "query.start"), std::pair(query.goal, "query.goal")}) {
    if (!within_bounds(problem, q)) throw InputError(name, "lies outside the bounds", "move it, or widen the bounds");
  }
  return query;
}

void add_problems(py::module_& core) {
  py::class_<PlanningProblem, SharedProblem>(
      core, "Problem", "A rigid robot among obstacles, where it may be and where it should go; never changes.")
      .def(py::init(&problem_of), py::arg("space"), py::arg("obstacles"), py::arg("robot") = py::tuple(), py::kw_only(),
           py::arg("bounds") = py::none(), py::arg("hold_body") = false, py::arg("queries") = py::tuple(),
           "Lengths in one unit, angles in radians.\n\n"
           "space: 'plane' (x, y), 'space' (x, y, z), 'se2' (x, y, angle) or 'se3' (x, y, z, quaternion w x y z).\n"
           "obstacles: a list of meshes; for a point in the plane a City.\n"
           "robot: meshes, its bodies in its own frame; none, a point. prisms() makes meshes of shapes in the plane.\n"
           "bounds: the lowest and the highest position, 2 x 2 or 2 x 3; left out, the box of the obstacles and 5 % "
           "more.\n"
           "hold_body: all of the robot stays within the bounds, not its origin alone.\n"
           "queries: pairs (start, goal).")
      .def_readonly("name", &PlanningProblem::name, "Of its file.")
      .def_property_readonly(
          "space", [](const PlanningProblem& problem) { return word_for(problem.kind, spaces); },
          "'plane', 'space', 'se2' or 'se3'.")
      .def_property_readonly(
          "robot", [](const SharedProblem& problem) { return meshes_of(problem, &PlanningProblem::robot); },
          "Its bodies, a Mesh each; none of a point.")
      .def_property_readonly(
          "obstacles", [](const SharedProblem& problem) { return meshes_of(problem, &PlanningProblem::obstacles); },
          "A Mesh each; none of a point in the plane.")
      .def_property_readonly(
          "footprints", [](const PlanningProblem& problem) { return footprints_out(problem.footprints); },
          "The obstacles of a point in the plane, polygons.")
      .def_property_readonly("bounds", &bounds_of, "2 x 2 or 2 x 3 float64; of a sphere the box around it.")
      .def_property_readonly("queries", &queries_of, "A pair (start, goal) each, float64.")
      .def("__repr__", [](const PlanningProblem& problem) {
        return fmt::format("<partwise.Problem {} in {}>", problem.name, word_for(problem.kind, spaces));
      });
  core.def("read_problem", &read_problem, py::arg("path"), py::kw_only(), py::arg("robot") = py::none(),
           py::arg("queries") = py::none(),
           "The planning problem of a .cfg (OMPL.app), .env (Parasol) or .json (docs/problems.md).\n\n"
           "robot, queries: the other files of an .env; left out, those beside it.");
  core.def("prisms", &prisms, py::arg("shape"), py::arg("low") = -0.5, py::arg("high") = 0.5,
           "A closed Mesh of each polygon, from z = low to z = high: robots and obstacles of the plane.\n\n"
           "shape: a list of polygons, each a list of rings (k x 2 arrays): the outer one, then holes.");
}

}  // namespace partwise::python
