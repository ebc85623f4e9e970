#include "partwise/motion/body_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/draw.h"
#include "partwise/motion/body_scene.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

Eigen::AlignedBox3d cube(double half) { return {Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half)}; }

// Of a configuration the point of its embedding, which is all that samples have.
Configuration configuration_of(const ConfigurationSpace& space, const MotionVector& x) {
  Configuration q(space.coordinates());
  if (space.kind() == SpaceKind::se2) {
    q << x[0], x[1], std::atan2(x[3], x[2]);
  } else if (space.kind() == SpaceKind::se3) {
    const Eigen::Matrix3d matrix =
        Eigen::Map<const Eigen::Matrix3d>(x.data() + 3) * std::numbers::sqrt2 / space.rotation_scale();
    const Eigen::Quaterniond turn(matrix);
    q << x.head<3>(), turn.w(), turn.x(), turn.y(), turn.z();
  } else {
    q = x;
  }
  return q;
}

// The sum of two boxes is a box: all samples lie on it, evenly.
TEST(BodyContacts, OfBoxesLieOnABox) {
  const ConfigurationSpace space(SpaceKind::space, cube(10));
  const std::vector<Mesh> obstacle = {box_mesh({1, 2, 3}, {3, 5, 4})}, body = {box_mesh({-0.5, -1, 0}, {1, 2, 0.5})};
  const ContactSamples found = body_contacts(space, body, obstacle, {0}, {.samples = 4000});
  EXPECT_EQ(found.size(), 4000);
  const Point low = Point(1, 2, 3) - Point(1, 2, 0.5), high = Point(3, 5, 4) - Point(-0.5, -1, 0);
  const Point size = high - low;
  const double all = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  std::array<int, 6> sides = {};
  for (const auto& x : found.points.rowwise()) {
    double off = 1e9;
    std::size_t side = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double from = std::abs(x[i / 2] - (i % 2 == 0 ? low : high)[i / 2]);
      if (from < off) off = from, side = i;
      EXPECT_GE(x[i / 2], low[i / 2] - 1e-9);
      EXPECT_LE(x[i / 2], high[i / 2] + 1e-9);
    }
    EXPECT_LT(off, 1e-9);
    ++sides[side];
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const double area = size.prod() / size[i / 2];
    EXPECT_NEAR(sides[i], 4000 * area / all, 3);
  }
}

TEST(BodyContacts, TouchTheirHull) {
  const std::vector<Mesh> bodies = {box_mesh({0, -0.1, -0.1}, {2, 0.1, 0.1}), box_mesh({-0.1, 0, -0.1}, {0.1, 1, 0.1})};
  const std::vector<Mesh> obstacles = {box_mesh({-3, -1, -1}, {-2, 1, 1}), box_mesh({2, -1, -1}, {3, 1, 0.5})};
  for (const SpaceKind kind : {SpaceKind::plane, SpaceKind::space, SpaceKind::se2, SpaceKind::se3}) {
    const auto scene = body_scene(kind, cube(6), bodies, obstacles, obstacles[0]);
    const ContactSamples found =
        body_contacts(scene->space(), bodies, obstacles, {0, 1}, {.samples = 400, .rotations = 40});
    EXPECT_EQ(found.count, 2);
    EXPECT_GT(found.size(), 400);
    const Eigen::Index positions = kind == SpaceKind::plane || kind == SpaceKind::se2 ? 2 : 3;
    int touching = 0;
    for (Eigen::Index i = 0; i < found.size(); ++i) {
      const int obstacle = found.obstacles[static_cast<std::size_t>(i)];
      const Configuration q = configuration_of(scene->space(), found.points.row(i).transpose());
      EXPECT_LT(scene->distance(q, obstacle).distance, 1e-8);
      // A hair to one side or another the robot is clear of it: it touches and does not overlap.
      Draw draw(1, static_cast<std::uint64_t>(i), 0);
      bool clear = false;
      for (int tries = 0; tries < 30 && !clear; ++tries) {
        Configuration beside = q;
        for (Eigen::Index k = 0; k < positions; ++k) beside[k] += draw.within(-1e-3, 1e-3);
        clear = scene->distance(beside, obstacle).distance > 0;
      }
      touching += clear;
    }
    EXPECT_GT(touching, 0.99 * static_cast<double>(found.size())) << static_cast<int>(kind);
  }
}

TEST(BodyContacts, OfCollisionOverlap) {
  const std::vector<Mesh> bodies = {box_mesh({0, -0.1, -0.1}, {2, 0.1, 0.1})};
  const std::vector<Mesh> obstacles = {box_mesh({-3, -1, -1}, {-2, 1, 1}), box_mesh({2, -1, -1}, {3, 1, 0.5})};
  const auto scene = body_scene(SpaceKind::se3, cube(6), bodies, obstacles, obstacles[0]);
  const ContactSamples found = body_contacts(scene->space(), bodies, obstacles, {0, 1},
                                             {.source = ContactSource::collision, .samples = 300, .rotations = 30});
  EXPECT_EQ(found.size(), 600);
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const Configuration q = configuration_of(scene->space(), found.points.row(i).transpose());
    EXPECT_EQ(scene->distance(q, found.obstacles[static_cast<std::size_t>(i)]).distance, 0);
  }
}

// Of few samples each obstacle gets as many, at fewer rotations if need be.
TEST(BodyContacts, ManyObstaclesShareTheSamples) {
  const std::vector<Mesh> bodies = {box_mesh({0, -0.1, -0.1}, {2, 0.1, 0.1})};
  const std::vector<Mesh> obstacles = {box_mesh({-3, -1, -1}, {-2, 1, 1}), box_mesh({2, -1, -1}, {3, 1, 0.5})};
  const ConfigurationSpace space(SpaceKind::se3, cube(6), body_radius(SpaceKind::se3, bodies));
  for (const int most : {6, 60, 120}) {
    const ContactSamples found =
        body_contacts(space, bodies, obstacles, {0, 1},
                      {.source = ContactSource::collision, .samples = 300, .most_samples = most, .rotations = 30});
    EXPECT_EQ(found.size(), most);
    EXPECT_EQ(std::ranges::count(found.obstacles, 0), most / 2);
  }
}

// The largest hole between rotations, against what as many random ones leave.
TEST(BodyContacts, SpreadRotationsEvenly) {
  const ConfigurationSpace space(SpaceKind::se3, cube(1), 1);
  const std::vector<Configuration> spread = spread_rotations(space, 200);
  Draw draw(4, 0, 0);
  std::vector<Configuration> random;
  for (int i = 0; i < 200; ++i) random.push_back(space.drawn(draw));
  const auto largest_hole = [&](const std::vector<Configuration>& rotations) {
    Draw probe(5, 0, 0);
    double largest = 0;
    for (int i = 0; i < 2000; ++i) {
      const Configuration q = space.drawn(probe);
      double nearest = 10;
      for (const Configuration& each : rotations) nearest = std::min(nearest, space.difference(each, q).tail(3).norm());
      largest = std::max(largest, nearest);
    }
    return largest;
  };
  EXPECT_LT(largest_hole(spread), 0.85 * largest_hole(random));
  EXPECT_LT(largest_hole(spread), 0.8);
}

}  // namespace
}  // namespace partwise
