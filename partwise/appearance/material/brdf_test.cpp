#include "partwise/appearance/material/brdf.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace partwise {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d above_horizon(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  const double z = uniform(random), phi = 2 * kPi * uniform(random), across = std::sqrt(1 - z * z);
  return {across * std::cos(phi), across * std::sin(phi), z};
}

TEST(HalfAngles, AreThoseOfTheDefinition) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d light = above_horizon(random), viewer = above_horizon(random);
    const HalfAngles angles = half_angles(light, viewer);
    const Eigen::Vector3d half = (light + viewer).normalized();
    EXPECT_NEAR(std::cos(angles.theta_h), half.z(), 1e-12);
    EXPECT_NEAR(std::cos(angles.theta_d), half.dot(light), 1e-12);
    const double phi_h = std::atan2(half.y(), half.x());
    const Eigen::Vector3d turned = Eigen::AngleAxisd(-angles.theta_h, Eigen::Vector3d::UnitY()) *
                                   (Eigen::AngleAxisd(-phi_h, Eigen::Vector3d::UnitZ()) * light);
    EXPECT_NEAR(turned.x(), std::sin(angles.theta_d) * std::cos(angles.phi_d), 1e-12);
    EXPECT_NEAR(turned.y(), std::sin(angles.theta_d) * std::sin(angles.phi_d), 1e-12);
  }
}

TEST(HalfAngles, AndDirectionsAreEachOthersReverse) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> quarter(0.01, kPi / 2 - 0.01), turn(-kPi + 0.01, kPi);
  for (int i = 0; i < 1000; ++i) {
    const HalfAngles angles{quarter(random), quarter(random), turn(random)};
    const DirectionPair pair = directions_of(angles);
    EXPECT_NEAR(pair.to_light.norm(), 1, 1e-12);
    EXPECT_NEAR(pair.to_viewer.norm(), 1, 1e-12);
    const HalfAngles back = half_angles(pair.to_light, pair.to_viewer);
    EXPECT_NEAR(back.theta_h, angles.theta_h, 1e-12);
    EXPECT_NEAR(back.theta_d, angles.theta_d, 1e-12);
    EXPECT_NEAR(back.phi_d, angles.phi_d, 1e-10);
  }
}

TEST(HalfAngles, DifferByHalfATurnWhenLightAndViewerChangePlaces) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d light = above_horizon(random), viewer = above_horizon(random);
    const HalfAngles there = half_angles(light, viewer), back = half_angles(viewer, light);
    EXPECT_EQ(there.theta_h, back.theta_h);
    EXPECT_EQ(there.theta_d, back.theta_d);
    EXPECT_NEAR(std::abs(there.phi_d - back.phi_d), kPi, 1e-9);
  }
}

// Where an arc cosine would lose half the digits or give no number at all.
TEST(HalfAngles, AreExactNearTheirEnds) {
  for (const double tiny : {1e-5, 1e-8, 1e-12}) {
    const HalfAngles mirror =
        half_angles({std::sin(0.3 + tiny), 0, std::cos(0.3 + tiny)}, {-std::sin(0.3), 0, std::cos(0.3)});
    EXPECT_NEAR(mirror.theta_h, tiny / 2, 1e-16);
    EXPECT_NEAR(mirror.theta_d, 0.3 + tiny / 2, 1e-15);
    const HalfAngles back = half_angles({std::sin(tiny), 0, std::cos(tiny)}, {-std::sin(tiny), 0, std::cos(tiny)});
    EXPECT_NEAR(back.theta_d, tiny, 1e-18);
  }
  const HalfAngles same = half_angles({0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(same.theta_h, 0);
  EXPECT_EQ(same.theta_d, 0);
  const HalfAngles opposite = half_angles({1, 0, 0}, {-1, 0, 0});
  EXPECT_EQ(opposite.theta_d, kPi / 2);
  EXPECT_TRUE(std::isfinite(opposite.phi_d));
}

}  // namespace
}  // namespace partwise
