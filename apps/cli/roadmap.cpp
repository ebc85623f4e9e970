// partwise roadmap: samples of the medial axis among obstacles, and the edges between them, with files.

#include "partwise/motion/roadmap.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "motion_pictures/roadmap_pictures.h"
#include "named_places.h"
#include "options.h"
#include "partwise/base/atomic_file.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/world.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

enum class Method { svma, maprm, maprm_exact };

const Choices<Method> methods = {
    {"svma", Method::svma}, {"maprm", Method::maprm}, {"maprm-exact", Method::maprm_exact}};
const Choices<StepSize> steps = {
    {"svm", StepSize::score}, {"clearance", StepSize::clearance}, {"combined", StepSize::combined}};

struct Options {
  std::string scene, samples_out, svg, glb;
  int limit = 0;
  double tolerance = 0;  // 0: the usual one
  Method method = Method::svma;
  MarginPushSettings push;
  AxisSamplesSettings sampling;
  RoadmapSettings connecting;
};

// One of these.
struct Obstacles {
  std::optional<City> city;
  std::optional<Mesh> mesh;
  std::optional<PlanningProblem> problem;

  bool flat() const { return city || (problem && !problem->footprints.empty()); }
  const std::vector<Polygons>& footprints() const { return city ? city->footprints : problem->footprints; }
};

bool is_city(const std::string& file) { return lower_ending(file) == ".geojson"; }
bool is_problem(const std::string& file) {
  const std::string ending = lower_ending(file);
  return ending == ".cfg" || ending == ".env" || ending == ".json";
}

void announce_outputs(const Options& options, Outputs& outputs) {
  outputs.add_input("SCENE", options.scene);
  if (!options.samples_out.empty()) outputs.add("--samples-out", options.samples_out, {".txt"});
  if (!options.svg.empty()) outputs.add("--svg", options.svg, {".svg"});
  if (!options.glb.empty()) outputs.add("--glb", options.glb, {".glb"});
}

void expect_fitting_pictures(const Obstacles& obstacles, const Options& options) {
  if (obstacles.flat() && !options.glb.empty())
    throw UsageError("--glb: these obstacles are of the plane; draw them with --svg");
  if (!obstacles.flat() && !options.svg.empty())
    throw UsageError("--svg: these obstacles are of space; show them with --glb");
}

Obstacles read_obstacles(const Options& options) {
  if (is_city(options.scene)) return {read_city(options.scene, options.limit), {}, {}};
  if (options.limit > 0) throw UsageError("--limit: keeps footprints of a city (.geojson); this has none");
  if (is_problem(options.scene)) return {{}, {}, read_planning_problem(options.scene)};
  return {{}, read_mesh(options.scene), {}};
}

World made_ready(const Obstacles& obstacles, const Options& options, const Progress& progress) {
  WorldSettings settings;
  if (options.tolerance > 0) settings.tolerance = options.tolerance;
  if (obstacles.problem) {
    ProblemWorldSettings of_problem;
    if (options.tolerance > 0) of_problem.tolerance = options.tolerance;
    return problem_world(*obstacles.problem, of_problem, progress);
  }
  if (obstacles.city) return city_world(*obstacles.city, settings, progress);
  return naming_mesh(options.scene, [&] { return mesh_world(*obstacles.mesh, settings, progress); });
}

std::string as_text(const AxisSamples& found) {
  std::string text;
  for (const AxisSample& each : found.samples) {
    for (const double coordinate : each.q) text += fmt::format("{} ", coordinate);
    text += fmt::format("{} {}\n", each.state.pair[0].distance, each.state.pair[1].distance);
  }
  return text;
}

void roadmap_of_file(const Options& options, Run& run) {
  announce_outputs(options, run.outputs);
  const Obstacles obstacles = run.stage("read", [&] { return read_obstacles(options); });
  expect_fitting_pictures(obstacles, options);
  const World world = naming_scene(
      options.scene, [&] { return run.stage("parts", [&] { return made_ready(obstacles, options, run.progress); }); });
  std::unique_ptr<Retractor> retract;
  if (options.method == Method::svma) {
    retract = naming_scene(options.scene, [&] {
      return run.stage("train", [&] {
        return trained_push(*world.scene, world.contacts, {.seed = run.seed}, options.push, run.progress);
      });
    });
  } else {
    retract = std::make_unique<Maprm>(*world.scene, MaprmSettings{.exact = options.method == Method::maprm_exact});
  }
  AxisSamplesSettings sampling = options.sampling;
  sampling.seed = run.seed;
  sampling.only_on_axis = options.method == Method::svma;
  const AxisSamples found =
      run.stage("sample", [&] { return axis_samples(*world.scene, *retract, sampling, run.progress); });
  if (found.samples.empty())
    throw InputError(options.scene, fmt::format("no sample of {} drawn arrived on the axis", found.drawn),
                     "leave room between the obstacles, or raise --epsilon");
  RoadmapSettings connecting = options.connecting;
  connecting.seed = run.seed;
  const Roadmap roadmap =
      run.stage("connect", [&] { return connected(*world.scene, found.samples, *retract, connecting, run.progress); });
  run.stage("write", [&] {
    if (!options.samples_out.empty()) write_file(run.outputs.staged("--samples-out"), as_text(found));
    if (!options.svg.empty())
      write_file(run.outputs.staged("--svg"), roadmap_svg(obstacles.footprints(), found.samples, roadmap));
    if (!options.glb.empty()) {
      const auto meshes = obstacles.mesh ? std::vector<Mesh>{*obstacles.mesh} : obstacles.problem->obstacles;
      write_roadmap_glb(run.outputs.staged("--glb"), meshes, found.samples, roadmap);
    }
  });

  nlohmann::ordered_json& json = run.report;
  json["samples"] = found.samples.size();
  json["on_axis"] = found.share_on_axis();
  json["edges"] = roadmap.edges.size();
  json["distance_queries"] = found.distance_queries + roadmap.distance_queries;
  json["collision_checks"] = found.collision_checks;
  json["components"] = roadmap.components;
  json["obstacles"] = world.scene->obstacles();
  json["drawn"] = found.drawn;
  json["lost"] = found.lost;
  json["steps"] = found.steps;
  json["within_ten_steps"] = found.quick;
  json["method"] = name_of(methods, options.method);
  json["input"] = options.scene;
  const std::string written =
      run.report_files({{"samples_out", options.samples_out}, {"svg", options.svg}, {"glb", options.glb}});
  const bool fewer = found.samples.size() < static_cast<std::size_t>(options.sampling.count);
  run.summary = fmt::format(
      "{}: {} samples among {} obstacles, {:.1f} % on the axis, {} edges{}{}", options.scene, found.samples.size(),
      world.scene->obstacles(), 100 * found.share_on_axis(), roadmap.edges.size(),
      fewer ? fmt::format("\nfewer than asked for: {} configurations were drawn", found.drawn) : "", written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("SCENE", options->scene,
                  "The obstacles: footprints of a city in degrees (.geojson), a mesh, or a planning problem (.cfg, "
                  ".env, .json)")
      ->required()
      ->type_name("");
  add_count(command, "--limit", options->limit, 1, "Of a city, the N footprints nearest to the centre [all]");
  add_choice(command, "--method", options->method, methods,
             "Max-margin fields, or medial-axis PRM with rays or with exact distances [svma]");
  add_count(command, "--samples", options->sampling.count, 1, "Samples of the axis [1000]");
  add_choice(command, "--step", options->push.step, steps,
             "Steps of svma: by the field's score, by clearances, or first one and then the other [combined]");
  add_positive(command, "--epsilon", options->push.epsilon,
               "Where svma stops: at this score, and at distances that differ by this share [0.02]");
  add_positive(command, "--tolerance", options->tolerance,
               "Concavity of the parts that are obstacles, as a share of R; without it a footprint is one obstacle and "
               "hollows have no axis of their own [meshes: 0.05]");
  add_count(command, "--neighbours", options->connecting.neighbours, 1, "Edges tried from each sample [8]");
  add_file(command, "--samples-out", options->samples_out,
           "Write a configuration a line (metres in a city), then its two smallest obstacle distances (.txt)");
  add_file(command, "--svg", options->svg, "Draw the roadmap of the plane (.svg)");
  add_file(command, "--glb", options->glb, "Show the roadmap of space (.glb); of a body, the ways of its origin");
  return [options](Run& run) { roadmap_of_file(*options, run); };
}

}  // namespace

const Verb roadmap_verb = {
    .name = "roadmap",
    .summary = "The medial axis of the free space among obstacles, as a graph",
    .details =
        "Samples are as far from the nearest obstacle as from the second one; edges stay near the axis and are free "
        "all\n"
        "along. svma writes only samples that were checked: their two distances differ by at most 2 %.",
    .example = "  partwise roadmap town.geojson --limit 354 --samples 40000 --svg town.svg --json -",
    .add = add,
};

}  // namespace partwise::cli
