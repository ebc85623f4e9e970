// partwise.plan: a path of a rigid robot among obstacles that keeps away from them.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "partwise/motion/axis_path.h"
#include "partwise/motion/path_simplify.h"
#include "problems.h"

namespace partwise::python {
namespace {

const Choices<AxisMethod> planners = {
    {"svma", AxisMethod::svma}, {"maprm", AxisMethod::maprm}, {"umaprm", AxisMethod::umaprm}};

struct Found {
  AxisPath axis;
  MotionPath path;
  std::vector<double> clearances;
  PathClearance clearance;
  double length = 0, found_length = 0, found_clearance = 0;
  int obstacles = 0;
};

struct PathArrays {
  py::array configurations, clearances, found;
  Found rest;  // the numbers
};

PathArrays as_arrays(Found found) {
  const auto coordinates = static_cast<py::ssize_t>(found.path.configurations.front().size());
  PathArrays arrays;
  arrays.configurations = rows_out(found.path.configurations, coordinates);
  arrays.clearances = vector_out(std::move(found.clearances));
  arrays.found = rows_out(found.axis.path.configurations, coordinates);
  arrays.rest = std::move(found);
  return arrays;
}

void expect_free(const Scene& scene, const Configuration& q, const char* which) {
  if (scene.within_bounds(q) && scene.free(q)) return;
  throw InputError("query", fmt::format("the robot touches an obstacle at the {}", which), "move it there");
}

Found found_along_axis(const PlanningProblem& problem, const MotionQuery& query, const AxisPathSettings& settings,
                       bool raw, double tolerance, const Progress& progress) {
  ProblemWorldSettings world;
  world.tolerance = tolerance;
  const ProblemScene made = problem_scene(problem, world, progress);
  const Scene& scene = *made.scene;
  expect_free(scene, query.start, "start");
  expect_free(scene, query.goal, "goal");
  std::optional<AxisPath> axis = axis_path(made, query, settings, progress);
  if (!axis) {
    throw InputError("problem",
                     fmt::format("{} found no path within {} s", word_for(settings.method, planners), settings.seconds),
                     "raise time, or try another planner or seed");
  }
  Found found;
  found.axis = std::move(*axis);
  found.path = raw ? found.axis.path : simplified(scene, found.axis.path, {.seed = settings.seed}, progress);
  for (const Configuration& q : found.path.configurations) {
    found.clearances.push_back(scene.nearest(q, 1).front().distance);
  }
  found.clearance = path_clearance(scene, found.path);
  found.length = path_length(scene.space(), found.path);
  found.found_length = path_length(scene.space(), found.axis.path);
  found.found_clearance = path_clearance(scene, found.axis.path).minimum;
  found.obstacles = scene.obstacles();
  return found;
}

PathArrays plan(const py::object& given, const py::object& given_query, const std::string& planner, double time,
                bool raw, double tolerance, std::uint64_t seed) {
  const SharedProblem problem = problem_in(given);
  const MotionQuery query = query_in(given_query, *problem);
  if (!(time > 0)) throw InputError("time", "is not above 0", "give seconds");
  if (!(tolerance > 0)) throw InputError("tolerance", "is not above 0", "0.05 is usual");
  const AxisPathSettings settings{.method = chosen("planner", planner, planners), .seconds = time, .seed = seed};
  return as_arrays(long_call(
      [&](const Progress& progress) { return found_along_axis(*problem, query, settings, raw, tolerance, progress); }));
}

}  // namespace

void add_paths(py::module_& core) {
  const auto number = [](auto Found::*member) {
    return [member](const PathArrays& path) { return path.rest.*member; };
  };
  py::class_<PathArrays>(core, "MotionPath", "Configurations with straight motions between them, from plan().")
      .def_readonly("configurations", &PathArrays::configurations,
                    "k x d float64, the coordinates of the problem's space.")
      .def_readonly("clearances", &PathArrays::clearances, "k float64, the distance of each to the nearest obstacle.")
      .def_readonly("found", &PathArrays::found, "The path as it was found, before it was shortened, such rows.")
      .def_property_readonly("length", number(&Found::length),
                             "The way, and for each radian that the robot turns its radius.")
      .def_property_readonly(
          "clearance_min", [](const PathArrays& path) { return path.rest.clearance.minimum; },
          "The smallest distance from an obstacle anywhere on the path, or up to 1 % more.")
      .def_property_readonly(
          "clearance_mean", [](const PathArrays& path) { return path.rest.clearance.mean; }, "Along the length.")
      .def_property_readonly("found_length", number(&Found::found_length), "Of the path as it was found.")
      .def_property_readonly("found_clearance_min", number(&Found::found_clearance), "Of the path as it was found.")
      .def_property_readonly(
          "samples", [](const PathArrays& path) { return path.rest.axis.samples; },
          "Of the roadmap that it was found on.")
      .def_property_readonly(
          "edges", [](const PathArrays& path) { return path.rest.axis.edges; }, "Of that roadmap.")
      .def_property_readonly("obstacles", number(&Found::obstacles), "How many there are, taken apart.")
      .def_property_readonly(
          "seconds", [](const PathArrays& path) { return path.rest.axis.seconds; }, "Wall time by stage.")
      .def("__len__", [](const PathArrays& path) { return path.configurations.shape(0); });
  core.def("plan", &plan, py::arg("problem"), py::arg("query") = 0, py::kw_only(), py::arg("planner") = "svma",
           py::arg("time") = 60.0, py::arg("raw") = false, py::arg("tolerance") = 0.05, py::arg("seed") = 0,
           "A path of a rigid robot that keeps away from obstacles, all of it free for certain (docs/plan.md).\n\n"
           "problem: a Problem. query: the number of one of its queries from 0, or a pair (start, goal).\n"
           "planner: 'svma', 'maprm' or 'umaprm'. time: seconds after which to give up, an InputError then.\n"
           "raw: as it was found; else it is shortened, keeping 0.9 of its smallest clearance.\n"
           "tolerance: concavity of the parts that obstacles are taken apart into, a share of their radius.");
}

}  // namespace partwise::python
