// partwise plan: a path of a rigid robot among obstacles that keeps away from them, with files.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion_pictures/path_scene.h"
#include "named_places.h"
#include "options.h"
#include "partwise/base/atomic_file.h"
#include "partwise/motion/axis_path.h"
#include "partwise/motion/path_simplify.h"
#include "plan_ompl.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

const Choices<std::string> planners = {{"svma", "svma"}, {"maprm", "maprm"}, {"umaprm", "umaprm"}, {"prm", "prm"}};
const Choices<std::string> samplers = {{"uniform", "uniform"},
                                       {"bridge", "bridge"},
                                       {"obstacle", "obstacle"},
                                       {"clearance", "clearance"},
                                       {"svma", "svma"}};

struct Options {
  std::string problem, robot, queries, path, glb, log;
  PlannerByName planner;
  double time = 60;
  int query = 1, runs = 1;
  bool raw = false;
  ProblemWorldSettings world;
};

struct Found {
  std::optional<MotionPath> path;  // of the first run that found one
  double seconds = 0;              // in the mean of those
  int solved = 0;
};

AxisMethod method_named(const std::string& planner) {
  if (planner == "maprm") return AxisMethod::maprm;
  return planner == "umaprm" ? AxisMethod::umaprm : AxisMethod::svma;
}

std::optional<MotionPath> along_the_axis(const ProblemScene& problem, const MotionQuery& query, const Options& options,
                                         Run& run) {
  const AxisPathSettings settings{
      .method = method_named(options.planner.planner), .seconds = options.time, .seed = run.seed};
  std::optional<AxisPath> found = axis_path(problem, query, settings, run.progress);
  if (!found) return std::nullopt;
  for (const auto& [stage, seconds] : found->seconds) run.seconds[stage] = seconds;
  run.report["samples"] = found->samples;
  run.report["edges"] = found->edges;
  return std::move(found->path);
}

Found find(const ProblemScene& problem, const MotionQuery& query, const Options& options, Run& run) {
  const auto start = std::chrono::steady_clock::now();
  Found found;
  PlannerByName planner = options.planner;
  planner.seed = run.seed;
  if (!options.log.empty()) {
    const LoggedRuns runs = run.stage("runs", [&] {
      return logged_runs(options.problem, problem, query, planner, options.time, options.runs, run.progress);
    });
    write_file(run.outputs.staged("--log"), runs.log);
    return {runs.path, runs.seconds, runs.solved};
  }
  if (planner.planner == "prm")
    found.path = run.stage("search", [&] { return path_by_ompl(problem, query, planner, options.time, run.progress); });
  else
    found.path = along_the_axis(problem, query, options, run);
  const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
  found.seconds = past.count();
  found.solved = found.path ? 1 : 0;
  return found;
}

const MotionQuery& chosen_query(const PlanningProblem& problem, const Options& options) {
  if (problem.queries.empty())
    throw InputError(options.problem, "asks for no path: it has no start and goal",
                     "add them: docs/problems.md says how");
  if (options.query > std::ssize(problem.queries))
    throw UsageError(fmt::format("--query: {} has {}", options.problem, problem.queries.size()));
  return problem.queries[static_cast<std::size_t>(options.query - 1)];
}

void expect_free(const Scene& scene, const Configuration& q, const Options& options, const std::string& which) {
  if (scene.within_bounds(q) && scene.free(q)) return;
  throw InputError(options.problem,
                   fmt::format("the robot touches an obstacle at the {} of query {}", which, options.query),
                   "move it there");
}

// A configuration a line, then its clearance.
std::string as_text(const Scene& scene, const MotionPath& path) {
  std::string text;
  for (const Configuration& q : path.configurations) {
    for (const double coordinate : q) text += fmt::format("{} ", coordinate);
    text += fmt::format("{}\n", scene.nearest(q, 1).front().distance);
  }
  return text;
}

void announce_outputs(const Options& options, Outputs& outputs) {
  outputs.add_input("PROBLEM", options.problem);
  if (!options.path.empty()) outputs.add("--path", options.path, {".txt"});
  if (!options.glb.empty()) outputs.add("--glb", options.glb, {".glb"});
  if (!options.log.empty()) outputs.add("--log", options.log, {".log"});
  if (options.runs > 1 && options.log.empty()) throw UsageError("--runs: is of a benchmark; say where with --log");
  if (options.planner.planner != "prm" && options.planner.sampler != "uniform")
    throw UsageError("--sampler: is of --planner prm");
}

void plan_file(const Options& options, Run& run) {
  announce_outputs(options, run.outputs);
  const PlanningProblem problem = run.stage("read", [&] {
    return read_planning_problem(options.problem, {.robot = options.robot, .query = options.queries});
  });
  const MotionQuery& query = chosen_query(problem, options);
  const ProblemScene made = naming_scene(options.problem, [&] {
    return run.stage("parts", [&] { return problem_scene(problem, options.world, run.progress); });
  });
  const Scene& scene = *made.scene;
  expect_free(scene, query.start, options, "start");
  expect_free(scene, query.goal, options, "goal");

  const Found found = naming_scene(options.problem, [&] { return find(made, query, options, run); });
  const bool needed = options.log.empty() || !options.path.empty() || !options.glb.empty();
  if (!found.path && needed)
    throw InputError(options.problem,
                     fmt::format("{} found no path within {} s", options.planner.planner, options.time),
                     "raise --time, or try another --planner or --seed");

  nlohmann::ordered_json& json = run.report;
  json["solved"] = found.path.has_value();
  std::string told = "no path";
  if (found.path) {
    const MotionPath path = options.raw ? *found.path : run.stage("simplify", [&] {
      return simplified(scene, *found.path, {.seed = run.seed}, run.progress);
    });
    const PathClearance clearance = path_clearance(scene, path);
    json["length"] = path_length(scene.space(), path);
    json["clearance_min"] = clearance.minimum;
    json["clearance_mean"] = clearance.mean;
    json["found_length"] = path_length(scene.space(), *found.path);
    json["found_clearance_min"] = path_clearance(scene, *found.path).minimum;
    json["configurations"] = path.configurations.size();
    told = fmt::format("a path of length {:.4g}, nowhere nearer than {:.3g} to an obstacle, {:.3g} in the mean",
                       path_length(scene.space(), path), clearance.minimum, clearance.mean);
    run.stage("write", [&] {
      if (!options.path.empty()) write_file(run.outputs.staged("--path"), as_text(scene, path));
      if (!options.glb.empty()) write_meshes(run.outputs.staged("--glb"), path_scene(problem, scene.space(), path));
    });
  }
  json["seconds_plan"] = found.seconds;
  json["runs"] = options.runs;
  json["runs_solved"] = found.solved;
  json["planner"] = options.planner.planner;
  if (options.planner.planner == "prm") json["sampler"] = options.planner.sampler;
  json["obstacles"] = scene.obstacles();
  json["input"] = options.problem;
  const std::string written = run.report_files({{"path", options.path}, {"glb", options.glb}, {"log", options.log}});
  const std::string of_runs =
      options.log.empty() ? "" : fmt::format(", {} of {} runs solved", found.solved, options.runs);
  run.summary = fmt::format("{}: {} in {:.2f} s{}{}", options.problem, told, found.seconds, of_runs, written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("PROBLEM", options->problem,
                  "Robot, obstacles, start and goal: OMPL.app's .cfg, Parasol's .env, or .json")
      ->required()
      ->type_name("");
  add_file(command, "--robot", options->robot, "Of an .env, its .robot file [the one beside it]");
  add_file(command, "--queries", options->queries, "Of an .env, its .query file [the one beside it]");
  add_count(command, "--query", options->query, 1, "Which of the problem's starts and goals [1]");
  add_choice(command, "--planner", options->planner.planner, planners,
             "Max-margin fields; medial-axis PRM with rays, or with samples spread evenly; OMPL's PRM [svma]");
  add_choice(command, "--sampler", options->planner.sampler, samplers,
             "What --planner prm draws states with; svma: on the axis [uniform]");
  add_positive(command, "--time", options->time, "Seconds after which to give up, training included [60]");
  command.add_flag("--raw", options->raw, "Leave the path as it was found; else it is shortened, keeping clearance");
  add_positive(command, "--tolerance", options->world.tolerance,
               "Concavity of the parts that obstacles are taken apart into, as a share of R [0.05]");
  add_file(command, "--path", options->path, "Write a configuration a line, then its clearance (.txt)");
  add_file(command, "--glb", options->glb, "Show the robot along the path (.glb)");
  add_count(command, "--runs", options->runs, 1, "Runs of a benchmark, each with a seed of its own [1]");
  add_file(command, "--log", options->log,
           "Write OMPL's benchmark log, for ompl_benchmark_statistics.py and Planner Arena (.log)");
  return [options](Run& run) { plan_file(*options, run); };
}

}  // namespace

const Verb plan_verb = {
    .name = "plan",
    .summary = "A path for a rigid robot that keeps away from obstacles",
    .details =
        "The path runs along the medial axis of the free space, as far from the nearest obstacle as from the second "
        "one,\n"
        "and is then shortened without coming nearer than 0.9 times its smallest clearance. All of it is free for\n"
        "certain, not at places that were looked at. Lengths count a turn by a radian as the robot's radius.",
    .example =
        "  partwise plan maze.env --path maze.txt --glb maze.glb\n"
        "  partwise plan piano.cfg --planner prm --sampler bridge --time 20 --runs 50 --log piano.log",
    .add = add,
};

}  // namespace partwise::cli
