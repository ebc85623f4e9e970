#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/util/Console.h>

#include <cmath>
#include <sstream>
#include <thread>

#include "partwise/base/draw.h"
#include "partwise/motion/ompl/clearance_objective.h"
#include "partwise/motion/ompl/ompl_scene.h"
#include "partwise/motion/ompl/planners.h"
#include "partwise/motion/ompl/svma_planner.h"
#include "partwise/motion/ompl/svma_sampler.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

namespace ob = ompl::base;

// A wall with a passage: of the plane, a point through a gap; of SE(3), a stick through a window.
PlanningProblem wall(SpaceKind kind) {
  PlanningProblem problem;
  problem.kind = kind;
  problem.bounds = {Eigen::Vector3d(-5, -5, -5), Eigen::Vector3d(5, 5, 5)};
  if (kind == SpaceKind::plane) {
    problem.footprints = {rectangle(-5, -0.5, 0.5, 0.5), rectangle(1.5, -0.5, 5, 0.5)};
    problem.queries = {{Configuration{{-3.0, -3.0}}, Configuration{{-3.0, 3.0}}}};
    return problem;
  }
  problem.robot = {box_mesh({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1})};
  problem.obstacles = {box_mesh({-6, -0.5, -6}, {0, 0.5, 6}), box_mesh({1.2, -0.5, -6}, {6, 0.5, 6})};
  Configuration start(kind == SpaceKind::se2 ? 3 : 7), goal;
  start.setZero();
  start.head(2) << -3, -3;
  if (kind == SpaceKind::se3) start[3] = 1;
  goal = start;
  goal[1] = 3;
  problem.queries = {{start, goal}};
  return problem;
}

class Ompl : public testing::TestWithParam<SpaceKind> {
 protected:
  Ompl() : problem_(wall(GetParam())), scene_(problem_scene(problem_)), si_(space_information(scene_.scene)) {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  }

  const ConfigurationSpace& space() const { return scene_.scene->space(); }
  ob::ScopedState<> state(const Configuration& q) const {
    ob::ScopedState<> result(si_);
    write_state(space(), q, result.get());
    return result;
  }
  // A start and a goal; both moved into the wall where they are to be invalid.
  ob::ProblemDefinitionPtr definition(bool valid_start = true, bool valid_goal = true) const {
    auto result = std::make_shared<ob::ProblemDefinition>(si_);
    MotionQuery query = problem_.queries[0];
    if (!valid_start) query.start[1] = 0;
    if (!valid_goal) query.goal[1] = 0;
    result->setStartAndGoalStates(state(query.start), state(query.goal));
    return result;
  }
  ob::PlannerPtr planner(const std::string& name = "svma") const {
    const ob::PlannerPtr result = named_planner(si_, scene_, {.planner = name});
    result->setProblemDefinition(definition());
    result->setup();
    return result;
  }
  void expect_path(const ob::PlannerPtr& planner) const {
    const auto path = planner->getProblemDefinition()->getSolutionPath();
    ASSERT_TRUE(path);
    EXPECT_TRUE(path->check());
    EXPECT_GT(path_clearance(*scene_.scene, motion_path(space(), *path->as<ompl::geometric::PathGeometric>())).minimum,
              0);
  }

  PlanningProblem problem_;
  ProblemScene scene_;
  ob::SpaceInformationPtr si_;
};

TEST_P(Ompl, DistancesAreDisplacementsAndStatesComeBack) {
  Draw draw(1, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const Configuration a = space().drawn(draw), b = space().drawn(draw);
    const double displacement = space().displacement(a, b);
    EXPECT_NEAR(si_->distance(state(a).get(), state(b).get()), displacement, 1e-6 * displacement);
    EXPECT_LT(space().displacement(configuration_of(space(), state(a).get()), a), 1e-7);
    ob::ScopedState<> middle(si_);
    si_->getStateSpace()->interpolate(state(a).get(), state(b).get(), 0.3, middle.get());
    EXPECT_LT(space().displacement(configuration_of(space(), middle.get()), space().between(a, b, 0.3)), 1e-6);
    EXPECT_EQ(si_->isValid(state(a).get()), scene_.scene->free(a));
  }
}

TEST_P(Ompl, MotionsAreValidWhereEveryPlaceIs) {
  Draw draw(2, 0, 0);
  int valid = 0, cut = 0;
  for (int i = 0; i < 60; ++i) {
    const auto a = state(space().drawn(draw)), b = state(space().drawn(draw));
    if (!si_->isValid(a.get())) continue;
    ob::ScopedState<> last(si_);
    std::pair<ob::State*, double> until(last.get(), 1);
    const bool free = si_->checkMotion(a.get(), b.get(), until);
    EXPECT_EQ(free, si_->checkMotion(a.get(), b.get()));
    (free ? valid : cut) += 1;
    for (int k = 0; k <= 100; ++k) {
      ob::ScopedState<> place(si_);
      si_->getStateSpace()->interpolate(a.get(), b.get(), until.second * k / 100, place.get());
      EXPECT_TRUE(si_->isValid(place.get()));
    }
    EXPECT_TRUE(free || si_->isValid(last.get()));
  }
  EXPECT_GT(valid, 3);
  EXPECT_GT(cut, 3);
}

// What OMPL asks of each of its planners.
TEST_P(Ompl, PlannersSolveClearAndGoOn) {
  for (const std::string name : {"svma", "maprm", "umaprm"}) {
    const ob::PlannerPtr each = planner(name);
    EXPECT_TRUE(each->solve(10.0)) << name;
    expect_path(each);
    each->clear();
    each->getProblemDefinition()->clearSolutionPaths();
    EXPECT_TRUE(each->solve(10.0));
    EXPECT_TRUE(each->solve(10.0));
    expect_path(each);
    each->clear();
    EXPECT_FALSE(each->solve(ob::plannerAlwaysTerminatingCondition()));
    each->solve(0.001);
    each->solve(0.01);
    EXPECT_TRUE(each->solve(0.1) || each->solve(10.0));
    each->clear();
    each->clear();
  }
}

TEST_P(Ompl, StopsWhenItIsTold) {
  const ob::PlannerPtr svma = planner();
  for (const unsigned most : {0u, 1u, 2u, 3u, 5u, 8u}) {  // asked in training first, later in sampling and connecting
    svma->clear();
    ob::IterationTerminationCondition condition(most);
    const ob::PlannerStatus status = svma->solve(condition);
    EXPECT_TRUE(status == ob::PlannerStatus::TIMEOUT || status == ob::PlannerStatus::EXACT_SOLUTION);
    EXPECT_TRUE(most >= 2 || status == ob::PlannerStatus::TIMEOUT);
  }
  EXPECT_TRUE(svma->solve(10.0));
}

TEST_P(Ompl, SaysWhatIsWrongWithStartsAndGoals) {
  const ob::PlannerPtr svma = planner();
  svma->setProblemDefinition(definition(false, true));
  svma->clear();
  EXPECT_EQ(svma->solve(2.0), ob::PlannerStatus::INVALID_START);
  svma->setProblemDefinition(definition(true, false));
  svma->clear();
  EXPECT_EQ(svma->solve(2.0), ob::PlannerStatus::INVALID_GOAL);
  struct Somewhere : ob::Goal {
    using ob::Goal::Goal;
    bool isSatisfied(const ob::State* /*state*/) const override { return false; }
  };
  const ob::ProblemDefinitionPtr vague = definition();
  vague->setGoal(std::make_shared<Somewhere>(si_));
  svma->setProblemDefinition(vague);
  svma->clear();
  EXPECT_EQ(svma->solve(2.0), ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE);
  svma->setProblemDefinition(definition());
  svma->clear();
  EXPECT_EQ(svma->solve(10.0), ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_P(Ompl, TakesTheValidOnesOfSeveralStartsAndGoals) {
  MotionQuery query = problem_.queries[0];
  const ob::ProblemDefinitionPtr several = definition(false, false);
  several->addStartState(state(query.start));
  const auto goals = std::make_shared<ob::GoalStates>(si_);
  Configuration bad = query.goal;
  bad[1] = 0;
  goals->addState(state(bad));
  goals->addState(state(query.goal));
  several->setGoal(goals);
  const ob::PlannerPtr svma = planner();
  svma->setProblemDefinition(several);
  EXPECT_EQ(svma->solve(10.0), ob::PlannerStatus::EXACT_SOLUTION);
  expect_path(svma);
  // Another query on the same roadmap.
  std::swap(query.start, query.goal);
  const auto back = std::make_shared<ob::ProblemDefinition>(si_);
  back->setStartAndGoalStates(state(query.start), state(query.goal));
  svma->clearQuery();
  svma->setProblemDefinition(back);
  EXPECT_EQ(svma->solve(5.0), ob::PlannerStatus::EXACT_SOLUTION);
  const MotionPath path = motion_path(space(), *back->getSolutionPath()->as<ompl::geometric::PathGeometric>());
  EXPECT_LT(space().displacement(path.configurations.front(), query.start), 1e-6);
}

TEST_P(Ompl, PlannersInTwoThreadsDoNotDisturbEachOther) {
  const ob::PlannerPtr a = planner(), b = planner();
  bool solved_a = false, solved_b = false;
  std::thread first([&] { solved_a = a->solve(20.0); }), second([&] { solved_b = b->solve(20.0); });
  first.join();
  second.join();
  EXPECT_TRUE(solved_a && solved_b);
  const auto found = [&](const ob::PlannerPtr& each) {
    return motion_path(space(), *each->getProblemDefinition()->getSolutionPath()->as<ompl::geometric::PathGeometric>());
  };
  ASSERT_EQ(found(a).configurations.size(), found(b).configurations.size());
  for (std::size_t i = 0; i < found(a).configurations.size(); ++i)
    EXPECT_EQ(found(a).configurations[i], found(b).configurations[i]);
}

TEST_P(Ompl, DataAreTheRoadmapAndStayTheSame) {
  const ob::PlannerPtr svma = planner();
  ASSERT_TRUE(svma->solve(10.0));
  ob::PlannerData data(si_);
  svma->getPlannerData(data);
  EXPECT_EQ(data.numStartVertices(), 1u);
  EXPECT_EQ(data.numGoalVertices(), 1u);
  EXPECT_GT(data.numVertices(), 10u);
  EXPECT_GT(data.numEdges(), 20u);
  const unsigned vertices = data.numVertices(), edges = data.numEdges();
  svma->getPlannerData(data);
  EXPECT_EQ(data.numVertices(), vertices);
  EXPECT_EQ(data.numEdges(), edges);
  for (unsigned i = 0; i < vertices; i += 7) {
    EXPECT_TRUE(si_->isValid(data.getVertex(i).getState()));
    std::vector<unsigned> next;
    data.getEdges(i, next);
    for (const unsigned k : next)
      EXPECT_TRUE(si_->checkMotion(data.getVertex(i).getState(), data.getVertex(k).getState()));
  }
}

TEST_P(Ompl, ParametersCanBeSet) {
  const ob::PlannerPtr svma = planner();
  for (const std::string name :
       {"batch", "free_share", "neighbours", "clearance_exponent", "seed", "epsilon", "density"})
    EXPECT_TRUE(svma->params().hasParam(name)) << name;
  EXPECT_TRUE(svma->params().setParam("epsilon", "0.01"));
  EXPECT_EQ(dynamic_cast<const SVMA&>(*svma).epsilon(), 0.01);
}

TEST_P(Ompl, SamplerGivesPrmStatesOnTheAxis) {
  const std::shared_ptr<const Retractor> push = trained_push(*scene_.scene, scene_.contacts({}));
  SvmaValidStateSampler sampler(si_.get(), scene_.scene, push);
  ob::ScopedState<> found(si_);
  int near = 0;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(sampler.sample(found.get()));
    const Configuration q = configuration_of(space(), found.get());
    EXPECT_TRUE(axis_state(*scene_.scene, q).on_axis());
    ob::ScopedState<> other(si_);
    if (!sampler.sampleNear(other.get(), found.get(), 1)) continue;
    ++near;
    EXPECT_LE(si_->distance(found.get(), other.get()), 1);
    EXPECT_TRUE(si_->isValid(other.get()));
  }
  EXPECT_GT(near, 10);
  const ob::PlannerPtr prm = named_planner(si_, scene_, {.planner = "prm", .sampler = "svma"});
  prm->setProblemDefinition(definition());
  EXPECT_TRUE(prm->solve(20.0));
}

TEST_P(Ompl, ObjectiveSeesWhatLiesBetweenStates) {
  const MinimumClearanceObjective objective(si_, scene_.scene);
  MotionQuery query = problem_.queries[0];
  query.start[0] = query.goal[0] = 1;  // on both sides of the passage
  const auto start = state(query.start), goal = state(query.goal);
  const double least = objective.motionCost(start.get(), goal.get()).value();
  EXPECT_LT(least, objective.stateCost(start.get()).value());
  EXPECT_EQ(objective.combineCosts(ob::Cost(2), ob::Cost(1)).value(), 1);
  EXPECT_TRUE(objective.isCostBetterThan(ob::Cost(2), ob::Cost(1)));
  EXPECT_EQ(objective.combineCosts(objective.identityCost(), ob::Cost(1)).value(), 1);
  EXPECT_TRUE(GetParam() != SpaceKind::plane || std::abs(least - 0.5) < 0.005);
}

TEST_P(Ompl, SimplifiesWithoutLosingClearance) {
  const ob::PlannerPtr svma = planner();
  ASSERT_TRUE(svma->solve(10.0));
  auto path = *svma->getProblemDefinition()->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  const double before = path_clearance(*scene_.scene, motion_path(space(), path)).minimum;
  const double length = path.length();
  simplify(path, *scene_.scene);
  EXPECT_GE(path_clearance(*scene_.scene, motion_path(space(), path)).minimum, 0.9 * before);
  EXPECT_LE(path.length(), (1 + 1e-9) * length);
  EXPECT_TRUE(path.check());
}

TEST_P(Ompl, LogsRunsAsItsScriptsReadThem) {
  std::ostringstream log;
  const auto runs = benchmark("wall", scene_, problem_.queries[0], {}, 10, 2, log);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_TRUE(runs[0].solved && runs[1].solved);
  EXPECT_NE(log.str().find("Experiment wall"), std::string::npos);
  EXPECT_NE(log.str().find("path minimum clearance REAL"), std::string::npos);
  EXPECT_NE(log.str().find("kept length REAL"), std::string::npos);
  MotionQuery bad = problem_.queries[0];
  bad.goal[1] = 0;
  EXPECT_THROW(planned(scene_, bad, {}, 1), InputError);
}

INSTANTIATE_TEST_SUITE_P(Spaces, Ompl, testing::Values(SpaceKind::plane, SpaceKind::se2, SpaceKind::se3),
                         [](const auto& each) {
                           return each.param == SpaceKind::plane ? "Plane"
                                  : each.param == SpaceKind::se2 ? "Se2"
                                                                 : "Se3";
                         });

}  // namespace
}  // namespace partwise
