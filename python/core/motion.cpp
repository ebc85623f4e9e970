// partwise.roadmap: the medial axis of the free space among obstacles, as a graph.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/roadmap.h"
#include "partwise/motion/world.h"
#include "problems.h"

namespace partwise::python {
namespace {

enum class Method { svma, maprm, maprm_exact };
const Choices<Method> methods = {
    {"svma", Method::svma}, {"maprm", Method::maprm}, {"maprm-exact", Method::maprm_exact}};
const Choices<StepSize> steps = {
    {"svm", StepSize::score}, {"clearance", StepSize::clearance}, {"combined", StepSize::combined}};

City city_of_footprints(const py::object& given) {
  City city{.footprints = {}, .centre = Eigen::Vector2d::Zero()};
  for (const Polygon& polygon : polygons_in(given, "footprints")) {
    const std::string place = fmt::format("footprints[{}]", city.footprints.size());
    city.footprints.push_back(valid_polygons({polygon}, false, place).polygons);
  }
  return city;
}

struct RoadmapSettingsIn {
  Method method = Method::svma;
  MarginPushSettings push;
  AxisSamplesSettings sampling;
  RoadmapSettings connecting;
};

struct Found {
  AxisSamples samples;
  Roadmap roadmap;
  int obstacles = 0;
};

Found found_among(const World& world, const RoadmapSettingsIn& settings, const Progress& progress) {
  std::unique_ptr<Retractor> retract;
  if (settings.method == Method::svma) {
    retract = trained_push(*world.scene, world.contacts, {.seed = settings.sampling.seed}, settings.push, progress);
  } else {
    retract = std::make_unique<Maprm>(*world.scene, MaprmSettings{.exact = settings.method == Method::maprm_exact});
  }
  Found found;
  found.samples = axis_samples(*world.scene, *retract, settings.sampling, progress);
  if (found.samples.samples.empty()) {
    throw InputError("obstacles", fmt::format("no sample of {} drawn arrived on the axis", found.samples.drawn),
                     "leave room between the obstacles, or raise epsilon");
  }
  found.roadmap = connected(*world.scene, found.samples.samples, *retract, settings.connecting, progress);
  found.obstacles = world.scene->obstacles();
  return found;
}

struct RoadmapArrays {
  py::array samples, distances, edges;
  py::list between;
  double on_axis = 0;
  int components = 0, obstacles = 0;
};

RoadmapArrays as_arrays(const Found& found) {
  std::vector<Configuration> places;
  std::vector<double> distances;
  std::vector<int> ends;
  for (const AxisSample& sample : found.samples.samples) {
    places.push_back(sample.q);
    for (const Near& near : sample.state.pair) distances.push_back(near.distance);
  }
  const auto coordinates = static_cast<py::ssize_t>(places.front().size());
  const auto samples = static_cast<py::ssize_t>(places.size());
  const auto edges = static_cast<py::ssize_t>(found.roadmap.edges.size());
  RoadmapArrays arrays;
  for (const RoadmapEdge& edge : found.roadmap.edges) {
    ends.insert(ends.end(), {edge.from, edge.to});
    arrays.between.append(rows_out(edge.between, coordinates));
  }
  arrays.samples = rows_out(places, coordinates);
  arrays.distances = array_out(std::move(distances), {samples, 2});
  arrays.edges = array_out(std::move(ends), {edges, 2});
  arrays.on_axis = found.samples.share_on_axis();
  arrays.components = found.roadmap.components;
  arrays.obstacles = found.obstacles;
  return arrays;
}

using WorldMaker = std::function<World(const Progress&)>;

// What is given is kept by the maker, which needs nothing of Python's.
WorldMaker world_maker(const py::object& obstacles, std::optional<double> tolerance) {
  const WorldSettings settings = {.tolerance = tolerance};
  if (py::isinstance<City>(obstacles)) {
    return [city = obstacles.cast<City>(), settings](const Progress& progress) {
      return city_world(city, settings, progress);
    };
  }
  if (py::isinstance<PlanningProblem>(obstacles)) {
    ProblemWorldSettings of_problem;
    of_problem.tolerance = tolerance.value_or(of_problem.tolerance);
    return [problem = problem_in(obstacles), of_problem](const Progress& progress) {
      return problem_world(*problem, of_problem, progress);
    };
  }
  return [mesh = mesh_in(obstacles, "obstacles"), settings](const Progress& progress) {
    return mesh_world(*mesh, settings, progress);
  };
}

RoadmapArrays roadmap(const py::object& obstacles, int samples, const std::string& method, const std::string& step,
                      double epsilon, std::optional<double> tolerance, int neighbours, std::uint64_t seed) {
  RoadmapSettingsIn settings;
  settings.method = chosen("method", method, methods);
  settings.push.step = chosen("step", step, steps);
  if (samples < 1) throw InputError("samples", "is less than 1", "give a number of samples");
  if (neighbours < 1) throw InputError("neighbours", "is less than 1", "give a number of edges to try");
  if (!(epsilon > 0)) throw InputError("epsilon", "is not above 0", "0.02 is usual");
  if (tolerance && !(*tolerance > 0)) throw InputError("tolerance", "is not above 0", "0.05 is usual");
  settings.push.epsilon = epsilon;
  settings.sampling = {.count = samples, .only_on_axis = settings.method == Method::svma, .seed = seed};
  settings.connecting = {.neighbours = neighbours, .seed = seed};
  const WorldMaker made_ready = world_maker(obstacles, tolerance);
  return as_arrays(
      long_call([&](const Progress& progress) { return found_among(made_ready(progress), settings, progress); }));
}

}  // namespace

void add_motion(py::module_& core) {
  py::class_<City>(core, "City", "Footprints of buildings in the plane, metres.")
      .def(py::init(&city_of_footprints), py::arg("footprints"),
           "Of polygons, each a list of rings (k x 2 arrays): the outer one, then holes.")
      .def_property_readonly(
          "footprints", [](const City& city) { return footprints_out(city.footprints); },
          "A copy of them, as they are given to City().")
      .def_readonly("centre", &City::centre, "Longitude and latitude of the origin, degrees.")
      .def("__len__", [](const City& city) { return city.footprints.size(); });
  core.def(
      "read_city",
      [](const std::filesystem::path& path, int limit) {
        if (limit < 0) throw InputError("limit", "is below 0", "give a number of footprints, or 0 for all");
        return long_call([&](const Progress&) { return read_city(path, limit); });
      },
      py::arg("path"), py::arg("limit") = 0,
      "The footprints of a .geojson in degrees, as metres about the centre of its box; limit keeps the nearest.");

  py::class_<RoadmapArrays>(core, "Roadmap", "A graph along the medial axis, from roadmap().")
      .def_readonly(
          "samples", &RoadmapArrays::samples,
          "n x d float64: in a city x, y (metres), in a mesh x, y, z, else the coordinates of the problem's space.")
      .def_readonly("distances", &RoadmapArrays::distances,
                    "n x 2 float64, from each sample to the nearest obstacle and to the next.")
      .def_readonly("edges", &RoadmapArrays::edges, "e x 2 int32, samples that free motions join.")
      .def_readonly("between", &RoadmapArrays::between, "Of each edge where it bends, k x d.")
      .def_readonly("on_axis", &RoadmapArrays::on_axis, "Share of samples whose distances differ by 2 % at most.")
      .def_readonly("components", &RoadmapArrays::components, "Of the graph.")
      .def_readonly("obstacles", &RoadmapArrays::obstacles, "How many there are.")
      .def("__len__", [](const RoadmapArrays& arrays) { return arrays.samples.shape(0); });
  core.def("roadmap", &roadmap, py::arg("obstacles"), py::kw_only(), py::arg("samples") = 1000,
           py::arg("method") = "svma", py::arg("step") = "combined", py::arg("epsilon") = 0.02,
           py::arg("tolerance") = py::none(), py::arg("neighbours") = 8, py::arg("seed") = 0,
           "The medial axis of the free space among obstacles (docs/roadmap.md).\n\n"
           "obstacles: a City or a mesh in space, for a point; or a Problem, for its robot.\n"
           "method: 'svma', 'maprm' or 'maprm-exact'. step, epsilon: of svma, 'svm', 'clearance' or 'combined', and "
           "where it stops.\n"
           "tolerance: concavity of the parts that are obstacles; left out, whole footprints of a City, else 0.05.\n"
           "neighbours: edges tried from each sample.");
}

}  // namespace partwise::python
