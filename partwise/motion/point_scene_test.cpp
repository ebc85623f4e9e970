#include "partwise/motion/point_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

struct Rectangle {
  double x0, y0, x1, y1;
  double boundary_distance(double x, double y) const {
    const double dx = std::max({x0 - x, 0.0, x - x1}), dy = std::max({y0 - y, 0.0, y - y1});
    if (dx > 0 || dy > 0) return std::hypot(dx, dy);
    return std::min({x - x0, x1 - x, y - y0, y1 - y});
  }
  bool holds(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

TEST(PointScene, KnowsRectanglesByClosedForm) {
  Draw draw(1, 0, 0);
  std::vector<Rectangle> rectangles;
  std::vector<Polygons> obstacles;
  for (int i = 0; i < 60; ++i) {
    const double x = draw.within(0, 100), y = draw.within(0, 100);
    rectangles.push_back({x, y, x + draw.within(0.5, 9), y + draw.within(0.5, 9)});
    const Rectangle& r = rectangles.back();
    obstacles.push_back(rectangle(r.x0, r.y0, r.x1, r.y1));
  }
  const auto scene = point_scene(obstacles, Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(110, 110)));
  for (int i = 0; i < 2000; ++i) {
    const Configuration q = scene->space().drawn(draw);
    std::vector<std::pair<double, int>> truth;
    bool free = true;
    for (const Rectangle& r : rectangles) {
      truth.emplace_back(r.boundary_distance(q[0], q[1]), static_cast<int>(truth.size()));
      free &= !r.holds(q[0], q[1]);
    }
    EXPECT_EQ(scene->free(q), free);
    EXPECT_NEAR(scene->distance(q, 17).distance, truth[17].first, 1e-9);
    std::ranges::sort(truth);
    const std::vector<Near> near = scene->nearest(q, 5);
    ASSERT_EQ(near.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(near[k].distance, truth[k].first, 1e-9);
      EXPECT_EQ(near[k].obstacle, truth[k].second);
      // The distance grows along its gradient, as fast as one goes.
      const Configuration on = scene->space().moved(q, 1e-6 * near[k].gradient);
      EXPECT_NEAR(scene->distance(on, near[k].obstacle).distance - near[k].distance, 1e-6, 1e-9);
    }
  }
}

TEST(PointScene, HasHolesAndTouchesBoundaries) {
  Polygons ring = rectangle(0, 0, 10, 10);
  Ring hole(4, 2);
  hole << 3, 3, 3, 7, 7, 7, 7, 3;
  ring[0].holes.push_back(hole);
  const auto scene =
      point_scene(std::vector<Polygons>{ring}, Eigen::AlignedBox2d(Eigen::Vector2d(-5, -5), Eigen::Vector2d(15, 15)));
  EXPECT_TRUE(scene->free(Configuration{{5.0, 5.0}}));
  EXPECT_FALSE(scene->free(Configuration{{1.0, 5.0}}));
  EXPECT_FALSE(scene->free(Configuration{{3.0, 5.0}}));  // on the rim of the hole
  EXPECT_FALSE(scene->free(Configuration{{10.0, 10.0}}));
  EXPECT_NEAR(scene->distance(Configuration{{5.0, 4.5}}, 0).distance, 1.5, 1e-12);
}

TEST(PointScene, KnowsBoxesInSpace) {
  const std::vector<Mesh> boxes = {box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({3, 0, 0}, {4, 1, 1})};
  Mesh both = boxes[0];
  both.vertices.conservativeResize(16, 3);
  both.vertices.bottomRows(8) = boxes[1].vertices;
  both.faces.conservativeResize(24, 3);
  both.faces.bottomRows(12) = boxes[1].faces.array() + 8;
  const auto scene =
      point_scene(boxes, both, Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(5, 2, 2)));
  EXPECT_EQ(scene->collision(Configuration{{0.5, 0.5, 0.5}}), 0);
  EXPECT_EQ(scene->collision(Configuration{{3.9, 0.5, 0.5}}), 1);
  EXPECT_TRUE(scene->free(Configuration{{2.0, 0.5, 0.5}}));
  const std::vector<Near> near = scene->nearest(Configuration{{1.5, 1.5, 0.5}}, 2);
  EXPECT_EQ(near[0].obstacle, 0);
  EXPECT_NEAR(near[0].distance, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(near[1].distance, std::hypot(1.5, 0.5), 1e-12);
}

TEST(PointScene, RefusesEmptyWorlds) {
  const Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  EXPECT_THROW(point_scene(std::vector<Polygons>{}, box), InputError);
  EXPECT_THROW(point_scene(std::vector<Polygons>{Polygons{}}, box), InputError);
}

}  // namespace
}  // namespace partwise
