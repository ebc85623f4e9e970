#include "partwise/motion/configuration_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Eigen::AlignedBox3d box(double x, double y, double z) { return {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(x, y, z)}; }

const Eigen::AlignedBox3d bounds(Eigen::Vector3d(-1, -2, -3), Eigen::Vector3d(4, 5, 6));
constexpr double scale = 2.5;
const std::vector<SpaceKind> kinds = {SpaceKind::plane, SpaceKind::space, SpaceKind::se2, SpaceKind::se3};

Tangent random_tangent(int size, double most, Draw& draw) {
  Tangent result(size);
  for (double& each : result) each = draw.within(-most, most);
  return result;
}

TEST(ConfigurationSpace, MovesByWhatLiesBetween) {
  for (const SpaceKind kind : kinds) {
    const ConfigurationSpace space(kind, bounds, scale);
    Draw draw(1, static_cast<std::uint64_t>(kind), 0);
    for (int i = 0; i < 200; ++i) {
      const Configuration a = space.drawn(draw), b = space.drawn(draw);
      EXPECT_TRUE(space.within_bounds(a));
      const Configuration there = space.moved(a, space.difference(a, b));
      EXPECT_LT((space.embedded(there) - space.embedded(b)).norm(), 1e-9);
      const Configuration half = space.between(a, b, 0.5);
      EXPECT_NEAR(space.difference(a, half).norm(), space.difference(half, b).norm(), 1e-9);
    }
  }
}

// Small motions are as long embedded as their tangents, wherever they start: the embedding is an isometry.
TEST(ConfigurationSpace, EmbedsIsometrically) {
  for (const SpaceKind kind : kinds) {
    const ConfigurationSpace space(kind, bounds, scale);
    Draw draw(2, static_cast<std::uint64_t>(kind), 0);
    for (int i = 0; i < 200; ++i) {
      const Configuration a = space.drawn(draw);
      const Tangent by = random_tangent(space.degrees_of_freedom(), 1e-5, draw);
      EXPECT_NEAR((space.embedded(space.moved(a, by)) - space.embedded(a)).norm(), by.norm(), 1e-9);
    }
  }
}

TEST(ConfigurationSpace, PullsGradientsBack) {
  for (const SpaceKind kind : kinds) {
    const ConfigurationSpace space(kind, bounds, scale);
    Draw draw(3, static_cast<std::uint64_t>(kind), 0);
    MotionVector g(space.embedding());
    for (double& each : g) each = draw.within(-1, 1);
    const Configuration a = space.drawn(draw);
    const Tangent gradient = space.pulled_back(a, g);
    for (int k = 0; k < space.degrees_of_freedom(); ++k) {
      constexpr double h = 1e-5;
      const Tangent by = h * Tangent::Unit(space.degrees_of_freedom(), k);
      const double difference = g.dot(space.embedded(space.moved(a, by)) - space.embedded(space.moved(a, -by)));
      EXPECT_NEAR(gradient[k], difference / (2 * h), 1e-8);
    }
  }
}

// A quaternion and its negative are one rotation, and angles do not jump.
TEST(ConfigurationSpace, HasNoSeams) {
  const ConfigurationSpace plane(SpaceKind::se2, bounds, scale);
  const Configuration left{{0.0, 0.0, std::numbers::pi - 1e-4}}, right{{0.0, 0.0, -std::numbers::pi + 1e-4}};
  EXPECT_NEAR(plane.displacement(left, right), scale * 2e-4, 1e-12);
  EXPECT_NEAR((plane.embedded(left) - plane.embedded(right)).norm(), scale * 2e-4, 1e-9);
  const ConfigurationSpace space(SpaceKind::se3, bounds, scale);
  Draw draw(4, 0, 0);
  Configuration a = space.drawn(draw), b = a;
  b.tail<4>() *= -1;
  EXPECT_LT((space.embedded(a) - space.embedded(b)).norm(), 1e-12);
  EXPECT_LT(space.displacement(a, b), 1e-12);
}

// No point of a body of radius `scale` moves farther than the displacement says.
TEST(ConfigurationSpace, DisplacementBoundsTheBody) {
  for (const SpaceKind kind : {SpaceKind::se2, SpaceKind::se3}) {
    const ConfigurationSpace space(kind, bounds, scale);
    Draw draw(5, static_cast<std::uint64_t>(kind), 0);
    for (int i = 0; i < 500; ++i) {
      const Configuration a = space.drawn(draw), b = space.drawn(draw);
      const Eigen::Vector3d direction(draw.within(-1, 1), draw.within(-1, 1), draw.within(-1, 1));
      const Eigen::Vector3d point = scale * direction.normalized();
      EXPECT_LE((space.pose(a) * point - space.pose(b) * point).norm(), space.displacement(a, b) + 1e-9);
    }
  }
}

// Rotations are drawn evenly: the mean of the matrices is 0, and each axis is as often up as down.
TEST(ConfigurationSpace, DrawsRotationsEvenly) {
  const ConfigurationSpace space(SpaceKind::se3, bounds, scale);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), squares = Eigen::Matrix3d::Zero();
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    Draw draw(6, static_cast<std::uint64_t>(i), 0);
    const Eigen::Matrix3d matrix = space.pose(space.drawn(draw)).linear();
    sum += matrix;
    squares += matrix.cwiseAbs2();
  }
  EXPECT_LT((sum / count).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((squares / count - Eigen::Matrix3d::Constant(1.0 / 3)).cwiseAbs().maxCoeff(), 0.01);
}

TEST(ConfigurationSpace, RefusesBoundsWithoutRoom) {
  EXPECT_THROW(ConfigurationSpace(SpaceKind::plane, box(1, 0, 0)), InputError);
  EXPECT_NO_THROW(ConfigurationSpace(SpaceKind::plane, box(1, 1, 0)));
  EXPECT_THROW(ConfigurationSpace(SpaceKind::space, box(1, 1, 0)), InputError);
}

}  // namespace
}  // namespace partwise
