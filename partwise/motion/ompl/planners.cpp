#include "partwise/motion/ompl/planners.h"

#include <ompl/base/samplers/BridgeTestValidStateSampler.h>
#include <ompl/base/samplers/MaximizeClearanceValidStateSampler.h>
#include <ompl/base/samplers/ObstacleBasedValidStateSampler.h>
#include <ompl/base/samplers/UniformValidStateSampler.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <memory>
#include <ostream>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/ompl/ompl_scene.h"
#include "partwise/motion/ompl/svma_planner.h"
#include "partwise/motion/ompl/svma_sampler.h"
#include "partwise/motion/umaprm.h"

namespace partwise {
namespace {

namespace ob = ompl::base;

template <typename Sampler>
ob::ValidStateSamplerPtr made(const ob::SpaceInformation* si) {
  return std::make_shared<Sampler>(si);
}

ob::ValidStateSamplerAllocator allocator(const ProblemScene& problem, const std::string& sampler) {
  if (sampler == "uniform") return made<ob::UniformValidStateSampler>;
  if (sampler == "bridge") return made<ob::BridgeTestValidStateSampler>;
  if (sampler == "obstacle") return made<ob::ObstacleBasedValidStateSampler>;
  if (sampler == "clearance") return made<ob::MaximizeClearanceValidStateSampler>;
  PARTWISE_CHECK(sampler, ==, "svma");
  return [problem](const ob::SpaceInformation* si) {
    const std::shared_ptr<const Retractor> push = trained_push(*problem.scene, problem.contacts({}));
    return svma_sampler_allocator(problem.scene, push)(si);
  };
}

void expect_free(const Scene& scene, const Configuration& q, const std::string& what) {
  if (!scene.within_bounds(q) || !scene.free(q))
    throw InputError(what, "the robot touches an obstacle, or is outside of the bounds", "move it");
}

ob::ProblemDefinitionPtr definition(const ob::SpaceInformationPtr& si, const ConfigurationSpace& space,
                                    const MotionQuery& query) {
  ob::ScopedState<> start(si), goal(si);
  write_state(space, query.start, start.get());
  write_state(space, query.goal, goal.get());
  auto result = std::make_shared<ob::ProblemDefinition>(si);
  result->setStartAndGoalStates(start, goal);
  return result;
}

MotionPath shortcut(const ob::SpaceInformationPtr& si, const ConfigurationSpace& space, const MotionPath& path) {
  const auto shorter = geometric_path(si, space, path);
  ompl::geometric::PathSimplifier simplifier(si);
  simplifier.reduceVertices(*shorter);
  simplifier.shortcutPath(*shorter);
  return motion_path(space, *shorter);
}

// OMPL talks to standard output, which belongs to the caller.
class Quiet {
 public:
  Quiet() { ompl::msg::noOutputHandler(); }
  ~Quiet() { ompl::msg::restorePreviousOutputHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

}  // namespace

ob::PlannerPtr named_planner(const ob::SpaceInformationPtr& si, const ProblemScene& problem,
                             const PlannerChoice& choice) {
  if (choice.planner == "prm") {
    si->setValidStateSamplerAllocator(allocator(problem, choice.sampler));
    auto prm = std::make_shared<ompl::geometric::PRM>(si);
    prm->setName("PRM-" + choice.sampler);
    return prm;
  }
  AxisPlannerSettings settings;
  settings.seed = choice.seed;
  settings.connecting.push = false;  // the peers join samples straight, as they were published
  const std::shared_ptr<const Scene> scene = problem.scene;
  if (choice.planner == "maprm") {
    settings.only_on_axis = false;
    return std::make_shared<MedialAxisPlanner>(
        si, scene, "MAPRM", [scene](const Progress&) { return std::make_unique<Maprm>(*scene); }, settings);
  }
  if (choice.planner == "umaprm") {
    return std::make_shared<MedialAxisPlanner>(
        si, scene, "UMAPRM", [scene](const Progress&) { return std::make_unique<Umaprm>(*scene); }, settings);
  }
  PARTWISE_CHECK(choice.planner, ==, "svma");
  auto svma = std::make_shared<SVMA>(si, problem);
  svma->set_seed(static_cast<unsigned>(choice.seed));
  return svma;
}

std::optional<MotionPath> planned(const ProblemScene& problem, const MotionQuery& query, const PlannerChoice& choice,
                                  double seconds, const Progress& progress) {
  expect_free(*problem.scene, query.start, "start");
  expect_free(*problem.scene, query.goal, "goal");
  const Quiet quiet;
  const ob::SpaceInformationPtr si = space_information(problem.scene);
  const ob::PlannerPtr planner = named_planner(si, problem, choice);
  planner->setProblemDefinition(definition(si, problem.scene->space(), query));
  planner->setup();
  const auto start = std::chrono::steady_clock::now();
  const auto over = [&] {
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
    return past.count() > seconds || (progress.cancelled && progress.cancelled());
  };
  const bool solved = planner->solve(ob::PlannerTerminationCondition(over)) == ob::PlannerStatus::EXACT_SOLUTION;
  progress("plan", 1);
  if (!solved) return std::nullopt;
  return motion_path(problem.scene->space(),
                     *planner->getProblemDefinition()->getSolutionPath()->as<ompl::geometric::PathGeometric>());
}

std::vector<BenchmarkRun> benchmark(const std::string& name, const ProblemScene& problem, const MotionQuery& query,
                                    const PlannerChoice& choice, double seconds, int runs, std::ostream& log,
                                    const Progress& progress) {
  const Scene& scene = *problem.scene;
  expect_free(scene, query.start, "start");
  expect_free(scene, query.goal, "goal");
  const Quiet quiet;
  ompl::geometric::SimpleSetup setup(space_information(problem.scene));
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const ob::ProblemDefinitionPtr wanted = definition(si, scene.space(), query);
  setup.setStartState(ob::ScopedState<>(si->getStateSpace(), wanted->getStartState(0)));
  setup.setGoal(wanted->getGoal());

  ompl::tools::Benchmark bench(setup, name);
  const ob::PlannerPtr planner = named_planner(si, problem, choice);
  bench.addPlanner(planner);
  std::vector<BenchmarkRun> found;
  bench.setPreRunEvent([&](const ob::PlannerPtr&) {
    if (auto* axis = dynamic_cast<MedialAxisPlanner*>(planner.get()))
      axis->set_seed(static_cast<unsigned>(choice.seed + found.size()));
    progress("plan", static_cast<double>(found.size()) / runs);
  });
  bench.setPostRunEvent([&](const ob::PlannerPtr&, ompl::tools::Benchmark::RunProperties& properties) {
    BenchmarkRun& run = found.emplace_back();
    run.seconds = std::stod(properties["time REAL"]);
    run.solved = setup.getProblemDefinition()->hasExactSolution();
    if (!run.solved) return;
    run.path = motion_path(scene.space(), setup.getSolutionPath());
    run.clearance = path_clearance(scene, run.path);
    const auto note = [&](const std::string& property, double value) {
      properties[property + " REAL"] = fmt::format("{}", value);
    };
    note("path length", path_length(scene.space(), run.path));
    note("path minimum clearance", run.clearance.minimum);
    note("path mean clearance", run.clearance.mean);
    const auto note_shorter = [&](const std::string& kind, const MotionPath& path) {
      note(kind + " length", path_length(scene.space(), path));
      note(kind + " minimum clearance", path_clearance(scene, path).minimum);
    };
    note_shorter("kept", simplified(scene, run.path));
    note_shorter("shortcut", shortcut(si, scene.space(), run.path));
  });
  ompl::tools::Benchmark::Request request(seconds, 1e6, static_cast<unsigned>(runs));
  request.displayProgress = request.saveConsoleOutput = request.simplify = false;
  bench.benchmark(request);
  bench.saveResultsToStream(log);
  return found;
}

}  // namespace partwise
