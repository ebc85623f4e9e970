#include "partwise/motion/body_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/motion/free_motion.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

Eigen::AlignedBox3d cube(double half) { return {Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half)}; }

Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const Eigen::Index vertices = all.vertices.rows(), faces = all.faces.rows();
    all.vertices.conservativeResize(vertices + mesh.vertices.rows(), 3);
    all.vertices.bottomRows(mesh.vertices.rows()) = mesh.vertices;
    all.faces.conservativeResize(faces + mesh.faces.rows(), 3);
    all.faces.bottomRows(mesh.faces.rows()) = mesh.faces.array() + static_cast<int>(vertices);
  }
  return all;
}

std::vector<Mesh> random_boxes(int count, Draw& draw) {
  std::vector<Mesh> boxes;
  for (int i = 0; i < count; ++i) {
    const Point low(draw.within(-9, 8), draw.within(-9, 8), draw.within(-9, 8));
    boxes.push_back(box_mesh(low, low + Point(draw.within(0.3, 2), draw.within(0.3, 2), draw.within(0.3, 2))));
  }
  return boxes;
}

// Three sticks at right angles, from the origin.
std::vector<Mesh> sticks() {
  return {box_mesh({0, -0.1, -0.1}, {2, 0.1, 0.1}), box_mesh({-0.1, 0, -0.1}, {0.1, 1.5, 0.1}),
          box_mesh({-0.1, -0.1, 0}, {0.1, 0.1, 1})};
}

std::unique_ptr<Scene> scene_of(SpaceKind kind, const std::vector<Mesh>& robot, const std::vector<Mesh>& obstacles,
                                double half = 10) {
  return body_scene(kind, cube(half), robot, obstacles, joined(obstacles));
}

TEST(BodyScene, HasTheGradientOfItsDistance) {
  Draw draw(2, 0, 0);
  for (const SpaceKind kind : {SpaceKind::plane, SpaceKind::space, SpaceKind::se2, SpaceKind::se3}) {
    const std::vector<Mesh> obstacles = random_boxes(6, draw);
    const auto scene = scene_of(kind, sticks(), obstacles);
    const ConfigurationSpace& space = scene->space();
    int asked = 0, right = 0;
    for (int i = 0; i < 60; ++i) {
      const Configuration q = space.drawn(draw);
      for (int obstacle = 0; obstacle < 6; ++obstacle) {
        const Near near = scene->distance(q, obstacle);
        if (near.distance < 1e-3) continue;
        ASSERT_EQ(near.gradient.size(), space.degrees_of_freedom());
        constexpr double h = 1e-6;
        Tangent slope(space.degrees_of_freedom());
        for (Eigen::Index k = 0; k < slope.size(); ++k) {
          const Tangent by = h * Tangent::Unit(slope.size(), k);
          slope[k] = (scene->distance(space.moved(q, by), obstacle).distance -
                      scene->distance(space.moved(q, -by), obstacle).distance) /
                     (2 * h);
        }
        ++asked;
        right += (slope - near.gradient).norm() < 1e-4;
      }
    }
    // Not where the nearest points change: for bodies that do not turn, between parallel faces, it stays the same.
    EXPECT_GT(asked, 200);
    EXPECT_GT(right, 0.99 * asked) << static_cast<int>(kind);
  }
}

TEST(BodyScene, NamesTheNearestAsAllDistancesDo) {
  Draw draw(3, 0, 0);
  const std::vector<Mesh> obstacles = random_boxes(80, draw);
  const auto scene = scene_of(SpaceKind::se3, sticks(), obstacles);
  for (int i = 0; i < 100; ++i) {
    const Configuration q = scene->space().drawn(draw);
    std::vector<std::pair<double, int>> all;
    for (int k = 0; k < 80; ++k) all.emplace_back(scene->distance(q, k).distance, k);
    std::ranges::sort(all);
    const std::vector<Near> near = scene->nearest(q, 5);
    ASSERT_EQ(near.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(near[k].obstacle, all[k].second);
      EXPECT_NEAR(near[k].distance, all[k].first, 1e-12);
    }
  }
}

TEST(BodyScene, IsInCollisionWhereItTouchesOrIsInside) {
  const std::vector<Mesh> obstacles = {box_mesh({-4, -4, -4}, {4, 4, 4}), box_mesh({6, 0, 0}, {6.5, 0.5, 0.5})};
  const auto small = scene_of(SpaceKind::space, {box_mesh({-1, -1, -1}, {1, 1, 1})}, obstacles, 20);
  EXPECT_EQ(small->collision(Configuration{{4.5, 0.0, 0.0}}), 0);
  EXPECT_EQ(small->collision(Configuration{{0.0, 0.5, 0.0}}), 0);     // wholly inside
  EXPECT_EQ(small->collision(Configuration{{6.25, 0.25, 0.25}}), 1);  // wholly around
  EXPECT_TRUE(small->free(Configuration{{9.0, 0.0, 0.0}}));
  EXPECT_NEAR(small->nearest(Configuration{{9.0, 0.0, 0.0}}, 1)[0].distance, 1.5, 1e-12);
  EXPECT_EQ(small->distance(Configuration{{4.5, 0.0, 0.0}}, 0).distance, 0);
  EXPECT_EQ(small->distance(Configuration{{4.5, 0.0, 0.0}}, 0).gradient.norm(), 0);
}

// Obstacles may be open parts of a closed solid; a hollow is free although its box lies in the solid's.
TEST(BodyScene, TellsInsideBySolid) {
  const Mesh outer = box_mesh({-4, -4, -4}, {4, 4, 4});
  Mesh inner = box_mesh({-2, -2, -2}, {2, 2, 2});
  inner.faces.col(1).swap(inner.faces.col(2));
  std::vector<Mesh> obstacles;
  for (const Mesh* mesh : {&static_cast<const Mesh&>(outer), &static_cast<const Mesh&>(inner)}) {
    for (Eigen::Index f = 0; f < 12; f += 2) obstacles.push_back({mesh->vertices, mesh->faces.middleRows(f, 2)});
  }
  const auto scene = body_scene(SpaceKind::se3, cube(8), {box_mesh({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2})}, obstacles,
                                joined({outer, inner}));
  Configuration q(7);
  q << 0, 0, 0, 1, 0, 0, 0;
  EXPECT_TRUE(scene->free(q));
  q[0] = 3;
  EXPECT_FALSE(scene->free(q));  // in the wall, touching nothing
  q[0] = 4.1;
  EXPECT_FALSE(scene->free(q));
  q[0] = 5;
  EXPECT_TRUE(scene->free(q));
}

// What roadmaps rely on: the distance falls by no more than the displacement.
TEST(BodyScene, DisplacementBoundsTheChangeOfDistance) {
  Draw draw(5, 0, 0);
  for (const SpaceKind kind : {SpaceKind::se2, SpaceKind::se3}) {
    const auto scene = scene_of(kind, sticks(), random_boxes(10, draw));
    const ConfigurationSpace& space = scene->space();
    EXPECT_NEAR(space.rotation_scale(), std::hypot(2, 0.1, kind == SpaceKind::se3 ? 0.1 : 0), 1e-12);
    for (int i = 0; i < 300; ++i) {
      const Configuration a = space.drawn(draw);
      Tangent by(space.degrees_of_freedom());
      for (double& each : by) each = draw.within(-0.5, 0.5);
      const Configuration b = space.moved(a, by);
      const double change = scene->nearest(a, 1)[0].distance - scene->nearest(b, 1)[0].distance;
      EXPECT_LE(std::abs(change), space.displacement(a, b) + 1e-9);
    }
  }
}

TEST(BodyScene, RefusesEmptyWorlds) {
  const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(body_scene(SpaceKind::space, cube(5), {}, {box}, box), InputError);
  EXPECT_THROW(body_scene(SpaceKind::space, cube(5), {box}, {}, box), InputError);
  EXPECT_THROW(body_scene(SpaceKind::space, cube(5), {box}, {Mesh{}}, box), InputError);
}

}  // namespace
}  // namespace partwise
