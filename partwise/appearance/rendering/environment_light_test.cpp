#include "partwise/appearance/rendering/environment_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double pi = std::numbers::pi;

EnvironmentLight random_light(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<float> value(1);
  Image map(width, height, 3);
  for (float& each : map.values) each = value(random) * value(random);
  return EnvironmentLight(std::move(map));
}

void expect_same_energy(const EnvironmentLight& a, const EnvironmentLight& b) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.energy()[k], b.energy()[k], 2e-6 * b.energy()[k]);
}

void expect_near(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float bound) {
  EXPECT_LT((a - b).norm(), bound) << a.transpose() << " and " << b.transpose();
}

TEST(EnvironmentLight, TheCentreFacesAwayFromTheViewerAndItsRightIsRight) {
  const EnvironmentLight light(Image(4, 3, 3));  // centres at u = 1/8, 3/8, 5/8, 7/8
  const float half = std::sqrt(0.5f);
  expect_near(light.direction(1, 1), {-half, 0, -half}, 1e-6f);
  expect_near(light.direction(2, 1), {half, 0, -half}, 1e-6f);
  expect_near(light.direction(3, 1), {half, 0, half}, 1e-6f);
  EXPECT_GT(light.direction(0, 0).y(), 0.8f);  // the top row is up
  EXPECT_LT(light.direction(0, 2).y(), -0.8f);
}

TEST(EnvironmentLight, SolidAnglesAddUpToTheSphere) {
  for (const int height : {1, 2, 7, 64}) {
    const EnvironmentLight light(Image(2 * height, height, 3, 1));
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += light.solid_angle(y) * light.width();
    EXPECT_NEAR(sum, 4 * pi, 1e-12);
    EXPECT_NEAR(light.energy()[1], 4 * pi, 1e-12);
  }
}

TEST(EnvironmentLight, ResizingKeepsTheEnergy) {
  const EnvironmentLight light = random_light(60, 37, 1);
  for (const auto& [width, height] : {std::pair(128, 64), {32, 16}, {60, 37}, {7, 5}, {1, 1}, {13, 200}, {241, 3}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    expect_same_energy(light.resized(width, height), light);
  }
  EXPECT_EQ(light.resized(60, 37).radiance().values, light.radiance().values);
}

TEST(EnvironmentLight, ResizingIsLocal) {  // a box filter: a pixel's light goes where the pixel is
  Image map(16, 8, 3);
  map.pixel(5, 2)[0] = 1;
  const EnvironmentLight small = EnvironmentLight(std::move(map)).resized(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(small.radiance().pixel(x, y)[0] > 0, x == 2 && y == 1);
  }
}

TEST(EnvironmentLight, RotatingByWholeColumnsMovesThemAsTheyAre) {
  const EnvironmentLight light = random_light(16, 8, 2);
  for (const int columns : {0, 1, 5, 16, -3, 37}) {
    const EnvironmentLight turned = light.rotated(columns * 360.0 / 16);
    for (int x = 0; x < 16; ++x) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(turned.radiance().pixel(x, 3)[k], light.radiance().pixel(((x + columns) % 16 + 16) % 16, 3)[k]);
      }
    }
  }
}

TEST(EnvironmentLight, RotatingByAnyAngleKeepsTheEnergy) {
  const EnvironmentLight light = random_light(31, 9, 3);
  for (const double degrees : {0.1, 17.3, -200.0, 359.99, 1e6}) expect_same_energy(light.rotated(degrees), light);
}

TEST(EnvironmentLight, RotationTurnsDirectionsCounterClockwiseFromAbove) {
  const EnvironmentLight light = random_light(36, 18, 4);
  const EnvironmentLight turned = light.rotated(40);  // four columns
  const Eigen::AngleAxisf turn(static_cast<float>(40 * pi / 180), Eigen::Vector3f::UnitY());
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3f d = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    expect_near(turned.sample(turn * d), light.sample(d), 2e-4f);
  }
}

TEST(EnvironmentLight, SamplingMeetsPixelsAndJoinsAtTheSeamAndThePoles) {
  const EnvironmentLight light = random_light(16, 8, 6);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      expect_near(light.sample(light.direction(x, y)), Eigen::Map<const Eigen::Vector3f>(light.radiance().pixel(x, y)),
                  1e-4f);
    }
  }
  const Eigen::Vector3f seam = light.sample({0, 0, 1}), right = light.sample({1e-6f, 0, 1}),
                        left = light.sample({-1e-6f, 0, 1});
  expect_near(seam, right, 1e-4f);
  expect_near(seam, left, 1e-4f);
  expect_near(light.sample({1e-7f, 1, 0}), light.sample({-1e-7f, 1, 0}), 1e-4f);
}

TEST(EnvironmentLight, NegativeValuesAreNoLightAndOthersAreRefused) {
  Image map(2, 1, 3, -0.25f);
  EXPECT_EQ(EnvironmentLight(map).energy().norm(), 0);
  map.values[2] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(EnvironmentLight{map}, InputError);
  EXPECT_THROW(EnvironmentLight(Image(2, 1, 4)), InputError);
}

TEST(EnvironmentLight, FourteenShip) {
  const std::vector<std::string> names = shipped_lights();
  EXPECT_EQ(names.size(), 14u);
  for (const std::string& name : names) {
    const EnvironmentLight light = shipped_light(name);
    EXPECT_EQ(light.width(), 512);
    EXPECT_GT(light.energy().minCoeff(), 0) << name;
    expect_same_energy(light.resized(128, 64), light);
  }
  try {
    shipped_light("moon");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("studio"));
  }
}

TEST(LightSamples, CarryTheEnergyInTheTurnedDirections) {
  EnvironmentLight light = random_light(12, 6, 7);
  Image map = light.radiance();
  std::fill_n(map.pixel(3, 2), 3, 0.0f);
  light = EnvironmentLight(std::move(map));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const LightSamples samples = light_samples(light, turn);
  EXPECT_EQ(samples.size(), 72);  // 71 with light, and one to make it a multiple of 8
  EXPECT_NEAR(samples.green.cast<double>().sum(), light.energy()[1], 1e-5 * light.energy()[1]);
  expect_near(samples.direction(1), (turn * light.direction(1, 0).cast<double>()).cast<float>(), 1e-6f);
  EXPECT_EQ(samples.red[71] + samples.green[71] + samples.blue[71], 0);
}

}  // namespace
}  // namespace partwise
