#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "partwise/base/draw.h"
#include "partwise/motion/axis_path.h"
#include "partwise/motion/axis_planner.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/path_simplify.h"
#include "partwise/motion/point_scene.h"
#include "partwise/motion/reached_region.h"
#include "partwise/motion/test_scenes.h"
#include "partwise/motion/umaprm.h"
#include "partwise/motion/world.h"

namespace partwise {
namespace {

Configuration at(double x, double y) { return Configuration{{x, y}}; }

const Eigen::AlignedBox2d wide(Eigen::Vector2d(-10, -10), Eigen::Vector2d(10, 10));

// Two halves of a wall across the bounds, with a passage one wide at x = 2, and a block beyond.
PlanningProblem wall_problem() {
  PlanningProblem problem;
  problem.kind = SpaceKind::plane;
  problem.footprints = {rectangle(-10, -1, 1.5, 1), rectangle(2.5, -1, 10, 1), rectangle(-4, 5, 4, 6)};
  problem.bounds = {Eigen::Vector3d(-10, -10, 0), Eigen::Vector3d(10, 10, 0)};
  return problem;
}

World wall_world() { return problem_world(wall_problem()); }

TEST(MotionPath, LengthAndPlaceOfACorner) {
  const ConfigurationSpace plane(SpaceKind::plane, {Eigen::Vector3d(-10, -10, 0), Eigen::Vector3d(10, 10, 0)});
  const MotionPath path{{at(0, 0), at(3, 0), at(3, 4)}};
  EXPECT_DOUBLE_EQ(path_length(plane, path), 7);
  EXPECT_TRUE(path_at(plane, path, 5.0 / 7).isApprox(at(3, 2)));
  EXPECT_EQ(path_at(plane, path, 0), at(0, 0));
  EXPECT_EQ(path_at(plane, path, 1), at(3, 4));
}

// Past a unit square: the nearest point is in the middle of a motion, the mean has a closed form.
TEST(MotionPath, ClearanceByClosedForms) {
  const auto scene = point_scene({rectangle(-0.5, -0.5, 0.5, 0.5)}, wide);
  const MotionPath beside{{at(-0.5, 2), at(0.5, 2)}};
  EXPECT_NEAR(path_clearance(*scene, beside).minimum, 1.5, 1e-12);
  EXPECT_NEAR(path_clearance(*scene, beside).mean, 1.5, 1e-12);
  const MotionPath past{{at(0.5, 2), at(6.5, 2)}};  // the distance from the corner, whose integral is known
  const double h = 1.5, x = 6, root = std::hypot(x, h);
  EXPECT_NEAR(path_clearance(*scene, past).minimum, 1.5, 1e-12);
  EXPECT_NEAR(path_clearance(*scene, past).mean, (x * root / 2 + h * h / 2 * std::log((x + root) / h)) / x, 2e-3);
  // Across a corner, the smallest distance far from both ends.
  const MotionPath across{{at(0.6, 9.7), at(9.3, 0.6)}};
  double least = 1e9;
  for (int i = 0; i <= 100000; ++i)
    least = std::min(least, scene->nearest(path_at(scene->space(), across, i / 100000.0), 1)[0].distance);
  EXPECT_GE(path_clearance(*scene, across).minimum, least - 1e-9);
  EXPECT_LE(path_clearance(*scene, across).minimum, 1.01 * least);
  EXPECT_EQ(path_clearance(*scene, {{at(-3, 0), at(3, 0)}}).minimum, 0);
  EXPECT_NEAR(path_clearance(*scene, {{at(3, 0)}}).mean, 2.5, 1e-12);
}

// All simple paths, for graphs of a few samples.
double best_by_hand(const Roadmap& roadmap, int samples, int from, int to, double exponent) {
  std::vector<bool> been(static_cast<std::size_t>(samples), false);
  const std::function<double(int)> go = [&](int here) {
    if (here == to) return 0.0;
    been[static_cast<std::size_t>(here)] = true;
    double best = std::numeric_limits<double>::infinity();
    for (const RoadmapEdge& edge : roadmap.edges) {
      if (edge.from != here && edge.to != here) continue;
      const int next = edge.from == here ? edge.to : edge.from;
      if (!been[static_cast<std::size_t>(next)])
        best = std::min(best, edge.length / std::pow(edge.clearance, exponent) + go(next));
    }
    been[static_cast<std::size_t>(here)] = false;
    return best;
  };
  return go(from);
}

TEST(PathSearch, FindsWhatBruteForceFinds) {
  constexpr int count = 7;
  int found = 0, none = 0;
  for (std::uint64_t round = 0; round < 60; ++round) {
    Draw draw(round, 0, 0);
    std::vector<AxisSample> samples;
    for (int i = 0; i < count; ++i) samples.push_back({at(i, 0), {}});  // names, not places
    Roadmap roadmap;
    for (int i = 0; i < count; ++i) {
      for (int k = i + 1; k < count; ++k) {
        if (draw.unit() < 0.3) roadmap.edges.push_back({i, k, {at(i, 1 + k)}, draw.within(1, 5), draw.within(0.1, 2)});
      }
    }
    const double exponent = static_cast<double>(round % 3);
    const auto path = path_search(roadmap, samples, {0}, {count - 1}, {.clearance_exponent = exponent});
    const double best = best_by_hand(roadmap, count, 0, count - 1, exponent);
    ASSERT_EQ(path.has_value(), std::isfinite(best));
    path ? ++found : ++none;
    if (!path) continue;
    double cost = 0;  // of the edges that the path says it takes: sample, bend, sample, ...
    for (std::size_t i = 0; i + 2 < path->configurations.size(); i += 2) {
      const int a = static_cast<int>(path->configurations[i][0]), b = static_cast<int>(path->configurations[i + 2][0]);
      const auto edge = std::ranges::find_if(roadmap.edges, [&](const RoadmapEdge& each) {
        return each.from == std::min(a, b) && each.to == std::max(a, b);
      });
      ASSERT_NE(edge, roadmap.edges.end());
      EXPECT_EQ(path->configurations[i + 1], edge->between[0]);
      cost += edge->length / std::pow(edge->clearance, exponent);
    }
    EXPECT_NEAR(cost, best, 1e-12 * best);
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(none, 3);
}

TEST(PathSearch, GoesOutOfItsWayForRoom) {
  const std::vector<AxisSample> samples = {{at(0, 0), {}}, {at(1, 1), {}}, {at(2, 0), {}}};
  const Roadmap roadmap{{{0, 1, {}, 2, 1}, {0, 2, {}, 2, 0.1}, {1, 2, {}, 2, 1}}};
  EXPECT_EQ(path_search(roadmap, samples, {0}, {2}, {.clearance_exponent = 0})->configurations.size(), 2u);
  EXPECT_EQ(path_search(roadmap, samples, {0}, {2}, {.clearance_exponent = 1})->configurations.size(), 3u);
  EXPECT_EQ(path_search(roadmap, samples, {0, 1}, {2, 1})->configurations.size(), 1u);
  EXPECT_FALSE(path_search({}, samples, {0}, {2}));
}

TEST(PathSimplify, KeepsClearanceAndShortens) {
  const World world = wall_world();
  const Scene& scene = *world.scene;
  const MotionPath zigzag{
      {at(-8, -5), at(-8, -2), at(-2, -6), at(2, -2), at(2, 0), at(2, 2), at(8, 3), at(8, 8), at(0, 8)}};
  const PathClearance before = path_clearance(scene, zigzag);
  EXPECT_NEAR(before.minimum, 0.5, 1e-9);
  const MotionPath shorter = simplified(scene, zigzag);
  EXPECT_EQ(shorter.configurations.front(), zigzag.configurations.front());
  EXPECT_EQ(shorter.configurations.back(), zigzag.configurations.back());
  EXPECT_GE(path_clearance(scene, shorter).minimum, 0.9 * before.minimum);
  // The shortest path that keeps 0.45 from the wall and the block: tight to corners in the end.
  EXPECT_LT(path_length(scene.space(), shorter), 0.75 * path_length(scene.space(), zigzag));
  EXPECT_EQ(simplified(scene, zigzag).configurations, shorter.configurations);
  const MotionPath hugging = simplified(scene, zigzag, {.keep = 0});
  EXPECT_GT(path_clearance(scene, hugging).minimum, 0);
  EXPECT_LT(path_length(scene.space(), hugging), path_length(scene.space(), shorter));
  EXPECT_EQ(simplified(scene, {{at(2, -3), at(2, 3)}}).configurations.size(), 2u);
}

TEST(AxisPlanner, FindsThePassageByAllMethods) {
  const World world = wall_world();
  const Scene& scene = *world.scene;
  const MarginField field(scene.space(), world.contacts);
  const MarginPush svma(scene, field);
  const Maprm maprm(scene), exact(scene, {.exact = true});
  const Umaprm umaprm(scene);
  for (const Retractor* retract : std::initializer_list<const Retractor*>{&svma, &maprm, &exact, &umaprm}) {
    AxisPlanner planner(scene, *retract, {.batch = 50, .only_on_axis = retract != &maprm});
    planner.add_start(at(-5, -5));
    planner.add_goal(at(-3, 9));
    planner.add_goal(at(8, 8));
    const MotionPath path = planner.solve({});
    EXPECT_EQ(path.configurations.front(), at(-5, -5));
    EXPECT_TRUE(path.configurations.back() == at(-3, 9) || path.configurations.back() == at(8, 8));
    const PathClearance clearance = path_clearance(scene, path);
    EXPECT_GT(clearance.minimum, retract == &maprm ? 0.0 : 0.4);
    EXPECT_LE(clearance.minimum, 0.5 + 1e-9);
  }
}

TEST(AxisPlanner, GoesOnAfterAStopAndFindsStraightWays) {
  const World world = wall_world();
  const MarginField field(world.scene->space(), world.contacts);
  const MarginPush push(*world.scene, field);
  AxisPlanner planner(*world.scene, push);
  planner.add_start(at(-5, -5));
  planner.add_goal(at(-5, -6));
  EXPECT_EQ(planner.solve({}).configurations.size(), 2u);
  planner.add_goal(at(0, 9));
  AxisPlanner stopped(*world.scene, push);
  stopped.add_start(at(-5, -5));
  stopped.add_goal(at(0, 9));
  int calls = 0;
  for (int most = 0; most < 6; ++most) {
    calls = 0;
    EXPECT_THROW(stopped.solve({{}, [&] { return ++calls > most; }}), Cancelled);
  }
  const MotionPath path = stopped.solve({});
  EXPECT_GT(path_clearance(*world.scene, path).minimum, 0);
  const std::vector<RoadmapEdge>& edges = stopped.roadmap().roadmap().edges;
  EXPECT_EQ(
      std::ranges::adjacent_find(edges, {}, [](const RoadmapEdge& each) { return std::pair(each.from, each.to); }),
      edges.end());
}

// A wall from side to side: what is drawn stays on the start's side, however far the place is; it goes along the wall.
TEST(ReachedRegion, WalksEndBeforeWalls) {
  const auto scene = point_scene({rectangle(-10, -1, 10, 1)}, wide);
  const auto sample = [&](double x, double y) { return AxisSample{at(x, y), axis_state(*scene, at(x, y))}; };
  const std::vector<AxisSample> samples = {sample(-5, -5), sample(-4, -5), sample(5, 5), sample(8, -8)};
  const Roadmap roadmap{{{0, 1, {}, 1, 4}}};
  int far = 0, along = 0;
  for (const std::size_t old : {std::size_t(1), samples.size()}) {
    const ReachedRegion reached(*scene, samples, roadmap, {0, 1}, old);
    for (std::uint64_t i = 0; i < 500; ++i) {
      Draw draw(3, i, 0);
      const Configuration q = reached.drawn(draw);
      ASSERT_TRUE(scene->within_bounds(q) && scene->free(q));
      ASSERT_LT(q.y(), -1);
      far += (q - at(-5, -5)).norm() > 6 ? 1 : 0;
      along += q.y() == -5 ? 1 : 0;
    }
  }
  EXPECT_GT(far, 20);
  EXPECT_GT(along, 300);  // of two samples that lie along x
  const ReachedRegion both(*scene, samples, roadmap, {0, 2}, 0);
  int above = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Draw draw(3, i, 0);
    above += both.drawn(draw).y() > 1 ? 1 : 0;
  }
  EXPECT_NEAR(above, 250, 60);
}

TEST(AxisPath, IsThePlannersAndEndsWithItsTime) {
  const ProblemScene problem = problem_scene(wall_problem());
  const MotionQuery query{at(-5, -5), at(-3, 9)};
  for (const AxisMethod method : {AxisMethod::svma, AxisMethod::maprm, AxisMethod::umaprm}) {
    const std::optional<AxisPath> found = axis_path(problem, query, {.method = method, .seed = 3});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->path.configurations.front(), query.start);
    EXPECT_EQ(found->path.configurations.back(), query.goal);
    EXPECT_GT(path_clearance(*problem.scene, found->path).minimum, 0);
    EXPECT_GT(found->samples, 2);
    EXPECT_GT(found->edges, 1);
    const std::optional<AxisPath> again = axis_path(problem, query, {.method = method, .seed = 3});
    EXPECT_EQ(again->path.configurations, found->path.configurations);
    EXPECT_FALSE(axis_path(problem, query, {.method = method, .seconds = 1e-9}));
    EXPECT_THROW(axis_path(problem, query, {.method = method}, {{}, [] { return true; }}), Cancelled);
  }
}

// Two walls: the axis is a line, samples of which are spread evenly.
TEST(Umaprm, SpreadsSamplesEvenly) {
  const auto scene = point_scene({rectangle(-10, -10, -4, 10), rectangle(4, -10, 10, 10)}, wide);
  const AxisSamples found = axis_samples(*scene, Umaprm(*scene), {.count = 1000});
  ASSERT_EQ(found.samples.size(), 1000u);
  EXPECT_EQ(found.share_on_axis(), 1);
  std::vector<int> bins(8, 0);
  for (const AxisSample& each : found.samples) {
    EXPECT_NEAR(each.q[0], 0, 0.05);
    ++bins[static_cast<std::size_t>(std::clamp((each.q[1] + 10) / 2.5, 0.0, 7.0))];
  }
  double chi2 = 0;  // of 6 inner bins; segments leave the bounds at the outer two
  const double mean = (1000 - bins.front() - bins.back()) / 6.0;
  for (std::size_t i = 1; i < 7; ++i) chi2 += (bins[i] - mean) * (bins[i] - mean) / mean;
  EXPECT_LT(chi2, 20.5);  // 0.1 % of five degrees of freedom
}

// A square in a ring of walls: medial-axis PRM crowds where cells are large, uniform sampling does not.
TEST(Umaprm, GivesSeveralSamplesOfOneSegment) {
  std::vector<Polygons> walls;
  for (int i = 0; i < 6; ++i) walls.push_back(rectangle(-10 + 3.5 * i, -10, -9 + 3.5 * i, 10));
  const auto scene = point_scene(walls, wide);
  const Umaprm umaprm(*scene, {.length = 20});
  std::size_t most = 0;
  for (std::uint64_t i = 0; i < 50; ++i) {
    Draw draw(1, i, 0);
    const std::vector<Retraction> found = umaprm.samples(at(-8.5, 0), draw);
    ASSERT_GE(found.size(), 1u);
    most = std::max(most, found.size());
    for (const Retraction& each : found) {
      EXPECT_TRUE(!each.done || axis_state(*scene, each.q).on_axis());
    }
  }
  EXPECT_GE(most, 2u);
}

}  // namespace
}  // namespace partwise
