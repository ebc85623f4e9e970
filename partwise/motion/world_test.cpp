#include "partwise/motion/world.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/motion/axis_samples.h"
#include "partwise/motion/free_motion.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

Eigen::AlignedBox3d cube(double half) { return {Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half)}; }

// Three sticks at right angles between two slabs and a post.
PlanningProblem sticks_between_slabs() {
  PlanningProblem problem;
  problem.name = "slabs";
  problem.kind = SpaceKind::se3;
  problem.robot = {box_mesh({0, -0.1, -0.1}, {1.5, 0.1, 0.1}), box_mesh({-0.1, 0, -0.1}, {0.1, 1.5, 0.1}),
                   box_mesh({-0.1, -0.1, 0}, {0.1, 0.1, 1.5})};
  problem.obstacles = {box_mesh({-6, -6, -6}, {6, 6, -4}), box_mesh({-6, -6, 4}, {6, 6, 6}),
                       box_mesh({-1, -1, -1}, {1, 1, 1})};
  problem.bounds = cube(6);
  return problem;
}

TEST(ProblemWorld, HasSamplesOnTheAxisOfSe3) {
  const PlanningProblem problem = sticks_between_slabs();
  std::vector<Configuration> first;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const World world = problem_world(problem);
    EXPECT_EQ(world.scene->obstacles(), 3);
    const MarginField field(world.scene->space(), world.contacts);
    const AxisSamples found = axis_samples(*world.scene, MarginPush(*world.scene, field), {.count = 300});
    ASSERT_EQ(found.samples.size(), 300u);
    EXPECT_LT(found.lost, found.drawn * 2 / 3);
    for (std::size_t i = 0; i < 300; ++i) {
      const Configuration& q = found.samples[i].q;
      EXPECT_TRUE(world.scene->free(q));
      const auto near = world.scene->nearest(q, 2);
      EXPECT_LE(near[1].distance - near[0].distance, axis_share * near[0].distance);
      if (threads == 1)
        first.push_back(q);
      else
        EXPECT_EQ(q, first[i]);
    }
  }
}

// An L of two boxes is two obstacles, unless it is to stay one.
TEST(ProblemWorld, DecomposesObstacles) {
  PlanningProblem problem;
  problem.kind = SpaceKind::space;
  Mesh l = box_mesh({0, 0, 0}, {4, 1, 1});
  const Mesh second = box_mesh({0, 0.5, 0}, {1, 4, 1});
  l.vertices.conservativeResize(16, 3);
  l.vertices.bottomRows(8) = second.vertices;
  l.faces.conservativeResize(24, 3);
  l.faces.bottomRows(12) = second.faces.array() + 8;
  problem.obstacles = {l, box_mesh({6, 6, 0}, {7, 7, 1})};
  problem.bounds = {Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(8, 8, 2)};
  const World parts = problem_world(problem);
  EXPECT_EQ(parts.scene->obstacles(), 3);
  EXPECT_EQ(parts.contacts.count, 3);
  const World whole = problem_world(problem, {.whole = true, .contacts = {}});
  EXPECT_EQ(whole.scene->obstacles(), 2);
  EXPECT_EQ(whole.contacts.count, 2);
  EXPECT_EQ(parts.scene->space().bounds().max().x(), 8);
  Draw draw(1, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const Configuration q = parts.scene->space().drawn(draw);
    EXPECT_EQ(parts.scene->free(q), whole.scene->free(q));
  }
}

TEST(ProblemWorld, KeepsFootprintsAndRefusesPointsThatTurn) {
  PlanningProblem flat;
  flat.kind = SpaceKind::plane;
  flat.footprints = {rectangle(0, 0, 4, 4), rectangle(6, 0, 9, 4)};
  flat.bounds = {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(10, 5, 0)};
  const World world = problem_world(flat);
  EXPECT_EQ(world.scene->obstacles(), 2);
  EXPECT_TRUE(world.scene->free(Configuration{{5.0, 2.0}}));
  EXPECT_FALSE(world.scene->free(Configuration{{1.0, 2.0}}));
  PlanningProblem point;
  point.kind = SpaceKind::se3;
  point.obstacles = {box_mesh({0, 0, 0}, {1, 1, 1})};
  point.bounds = cube(4);
  EXPECT_THROW(problem_world(point), InputError);
}

// Parasol's bounds: the body stays inside, and so does every motion that is found free.
TEST(ProblemWorld, BoundsMayHoldTheBody) {
  PlanningProblem problem = sticks_between_slabs();
  problem.bounds_hold_body = true;
  problem.sphere = Sphere{Point(0, 0, 0), 7};
  const World world = problem_world(problem);
  const Scene& scene = *world.scene;
  Configuration q(7);
  q << 4, 0, 0, 1, 0, 0, 0;
  EXPECT_NEAR(scene.room(q), 0.5, 1e-12);
  q[0] = 4.6;
  EXPECT_FALSE(scene.within_bounds(q));
  q.head(3) << 4, 4.2, -4.2;
  EXPECT_NEAR(scene.room(q), 7 - std::hypot(5.5, 4.3, 4.3) > 0 ? 7 - std::hypot(5.5, 4.3, 4.3) : 0, 1e-12);
  Draw draw(7, 0, 0);
  int within = 0, moved = 0;
  for (int i = 0; i < 400; ++i) {
    const Configuration a = scene.space().drawn(draw), b = scene.space().drawn(draw);
    EXPECT_EQ(scene.within_bounds(a), within_bounds(problem, a));
    within += scene.within_bounds(a);
    const MotionCheck check = free_motion(scene, a, clearance(scene, a), b, clearance(scene, b), 1e-3);
    if (!check.free) continue;
    ++moved;
    for (int k = 0; k <= 50; ++k) EXPECT_TRUE(within_bounds(problem, scene.space().between(a, b, k / 50.0)));
  }
  EXPECT_GT(within, 30);
  EXPECT_GT(moved, 5);
}

}  // namespace
}  // namespace partwise
