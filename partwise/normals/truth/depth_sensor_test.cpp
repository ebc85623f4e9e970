#include "partwise/normals/truth/depth_sensor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

using Eigen::Vector3d;
using test::depth_picture;
using test::PlaneDepth;

constexpr PinholeCamera camera{290, 290, 159.5, 119.5};
constexpr int width = 320, height = 240;

// Nothing but what a test turns on.
DepthSensor ideal() {
  DepthSensor sensor;
  sensor.shift_step = 1e-7;
  sensor.shift_noise = sensor.lateral = sensor.edge_loss = 0;
  sensor.grazing_from = 91, sensor.grazing_to = 92;
  sensor.nearest = 0.1, sensor.farthest = 100;
  sensor.shadow = false;
  return sensor;
}

Image normals_like(const Vector3d& normal, int wide = width, int high = height) {
  Image image(wide, high, 3);
  for (int y = 0; y < high; ++y) {
    for (int x = 0; x < wide; ++x) Eigen::Map<Eigen::Vector3f>(image.pixel(x, y)) = normal.cast<float>();
  }
  return image;
}

struct Plane {
  explicit Plane(double slant, double towards, double distance)
      : normals(normals_like(test::slanted(slant, towards))),
        depth(depth_picture(camera, width, height, PlaneDepth{test::slanted(slant, towards), distance})) {}
  Image normals, depth;
};

double share_lost(const Image& depth) {
  const auto lost = std::ranges::count(depth.values, 0.0f);
  return static_cast<double>(lost) / static_cast<double>(depth.values.size());
}

double inverse_difference(float sensed, float truth) {
  return 1 / static_cast<double>(sensed) - 1 / static_cast<double>(truth);
}

TEST(DepthSensor, AnIdealOneGivesTheDepth) {
  const Plane plane(50, 30, 2);
  const Image sensed = sensed_depth(plane.depth, plane.normals, camera, ideal(), 1);
  for (std::size_t i = 0; i < sensed.values.size(); ++i) EXPECT_NEAR(sensed.values[i], plane.depth.values[i], 1e-5f);
}

TEST(DepthSensor, StepsGrowWithTheSquareOfTheDepth) {
  DepthSensor sensor = ideal();
  sensor.shift_step = 1.0 / 8;
  EXPECT_NEAR(1 / sensor.step(), 348, 1e-9);
  const Plane plane(40, 30, 1.5);
  const Image sensed = sensed_depth(plane.depth, plane.normals, camera, sensor, 1);
  const std::set<float> levels(sensed.values.begin(), sensed.values.end());
  EXPECT_GT(levels.size(), 150u);
  for (auto next = std::next(levels.begin()); next != levels.end(); ++next) {
    const double low = *std::prev(next), high = *next;
    EXPECT_NEAR((high - low) / (low * high), sensor.step(), 1e-6);
    EXPECT_NEAR((high - low) / (high * high) / sensor.step(), 1, 0.03);
  }
  for (std::size_t i = 0; i < sensed.values.size(); ++i) {
    EXPECT_LE(std::abs(inverse_difference(sensed.values[i], plane.depth.values[i])), sensor.step() / 2 + 1e-7);
  }
}

TEST(DepthSensor, NoiseIsAddedBeforeRounding) {
  DepthSensor sensor = ideal();
  sensor.shift_step = 1.0 / 8;
  sensor.shift_noise = 0.5;
  const Plane plane(45, 20, 1.5);
  const Image sensed = sensed_depth(plane.depth, plane.normals, camera, sensor, 3);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < sensed.values.size(); ++i) {
    const double error = inverse_difference(sensed.values[i], plane.depth.values[i]) / sensor.step();
    sum += error, squares += error * error;
  }
  const auto count = static_cast<double>(sensed.values.size());
  EXPECT_NEAR(sum / count, 0, 0.01);
  EXPECT_NEAR(squares / count, 0.25 + 1.0 / 12, 0.01);
}

TEST(DepthSensor, LateralNoiseFollowsTheSlope) {
  DepthSensor sensor = ideal();
  sensor.lateral = 0.5;
  const Plane plane(55, 0, 1.5);
  const Image sensed = sensed_depth(plane.depth, plane.normals, camera, sensor, 3);
  // On a plane the inverse depth changes by the same from column to column.
  const double slope = inverse_difference(plane.depth.pixel(101, 100)[0], plane.depth.pixel(100, 100)[0]);
  double squares = 0;
  for (int y = 5; y < height - 5; ++y) {
    for (int x = 5; x < width - 5; ++x) {
      squares += std::pow(inverse_difference(sensed.pixel(x, y)[0], plane.depth.pixel(x, y)[0]) / slope, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(squares / ((width - 10) * (height - 10))), 0.5, 0.01);
}

// A square before a wall.
struct SquareBeforeWall {
  static constexpr int first_x = 120, last_x = 219, first_y = 60, last_y = 159;
  static constexpr double near = 1, far = 1.6;
  static bool is_near(int x, int y) { return x >= first_x && x <= last_x && y >= first_y && y <= last_y; }
  SquareBeforeWall() : normals(normals_like(Vector3d::UnitZ())), depth(width, height, 1) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) depth.pixel(x, y)[0] = static_cast<float>(is_near(x, y) ? near : far);
    }
  }
  Image normals, depth;
};

TEST(DepthSensor, LosesItsShareBesideSteps) {
  const SquareBeforeWall scene;
  DepthSensor sensor = ideal();
  sensor.edge_loss = 0.6;
  const Image sensed = sensed_depth(scene.depth, scene.normals, camera, sensor, 5);
  int beside = 0, lost = 0;
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const bool near = SquareBeforeWall::is_near(x, y);
      const bool edge = SquareBeforeWall::is_near(x - 1, y) != near || SquareBeforeWall::is_near(x + 1, y) != near ||
                        SquareBeforeWall::is_near(x, y - 1) != near || SquareBeforeWall::is_near(x, y + 1) != near;
      if (edge) {
        ++beside;
        lost += sensed.pixel(x, y)[0] == 0 ? 1 : 0;
      } else {
        EXPECT_NE(sensed.pixel(x, y)[0], 0) << x << ' ' << y;
      }
    }
  }
  EXPECT_EQ(beside, 2 * 400 - 4);
  EXPECT_NEAR(lost, 0.6 * beside, 3.5 * std::sqrt(0.24 * beside));
}

TEST(DepthSensor, NearThingsCastAShadowToTheLeft) {
  const SquareBeforeWall scene;
  DepthSensor sensor = ideal();
  sensor.shadow = true;
  const Image sensed = sensed_depth(scene.depth, scene.normals, camera, sensor, 5);
  const double shadow = camera.focal_x * sensor.baseline * (1 / SquareBeforeWall::near - 1 / SquareBeforeWall::far);
  EXPECT_GT(shadow, 8);
  for (int y = 0; y < height; ++y) {
    int lost = 0;
    for (int x = 0; x < width; ++x) {
      if (sensed.pixel(x, y)[0] != 0) continue;
      ++lost;
      EXPECT_LT(x, SquareBeforeWall::first_x);
      EXPECT_GE(x, SquareBeforeWall::first_x - shadow);
    }
    EXPECT_EQ(lost, SquareBeforeWall::is_near(SquareBeforeWall::first_x, y) ? static_cast<int>(shadow) : 0) << y;
  }
}

TEST(DepthSensor, OutlinesBecomeRagged) {
  const SquareBeforeWall scene;
  DepthSensor sensor = ideal();
  sensor.lateral = 0.5;
  const Image sensed = sensed_depth(scene.depth, scene.normals, camera, sensor, 5);
  int changed = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float z = sensed.pixel(x, y)[0];
      const bool near = std::abs(z - 1) < 1e-4f, far = std::abs(z - 1.6f) < 1e-4f;
      EXPECT_TRUE(near || far) << z;  // and nothing floats between
      changed += near != SquareBeforeWall::is_near(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 60);
  EXPECT_LT(changed, 400);
}

TEST(DepthSensor, GrazingAnglesLoseAShareThatGrows) {
  constexpr PinholeCamera tele{40000, 40000, 159.5, 119.5};  // the angle is the same all over the picture
  for (const double slant : {65.0, 72.0, 79.0, 86.0}) {
    const Vector3d normal = test::slanted(slant, 130);
    DepthSensor sensor = ideal();
    sensor.grazing_from = 70, sensor.grazing_to = 85;
    sensor.patch = 4;
    const Image depth = depth_picture(tele, width, height, PlaneDepth{normal, 2});
    const Image sensed = sensed_depth(depth, normals_like(normal), tele, sensor, 11);
    EXPECT_NEAR(share_lost(sensed), std::clamp((slant - 70) / 15, 0.0, 1.0), 0.035) << slant;
  }
}

TEST(DepthSensor, MirrorsLoseTheirShareInPatches) {
  const Plane plane(0, 0, 1.5);
  const DepthSensor sensor = ideal();
  for (const float mirror : {0.0f, 0.3f, 1.0f}) {
    const Image sensed = sensed_depth(plane.depth, plane.normals, Image(width, height, 1, mirror), camera, sensor, 2);
    EXPECT_NEAR(share_lost(sensed), static_cast<double>(mirror), mirror == 0.3f ? 0.03 : 0);
    if (mirror != 0.3f) continue;
    int pairs = 0, lost = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x + 1 < width; ++x) {
        if (sensed.pixel(x, y)[0] != 0) continue;
        ++pairs;
        lost += sensed.pixel(x + 1, y)[0] == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(static_cast<double>(lost) / pairs, 0.7);  // alone, it were 0.3
  }
}

TEST(DepthSensor, RangeIsLimited) {
  Image depth(4, 1, 1);
  depth.values = {0.49f, 0.51f, 7.9f, 8.3f};
  DepthSensor sensor = ideal();
  sensor.nearest = 0.5, sensor.farthest = 8;
  const Image sensed = sensed_depth(depth, normals_like(Vector3d::UnitZ(), 4, 1), camera, sensor, 1);
  EXPECT_EQ(sensed.values[0], 0);
  EXPECT_NEAR(sensed.values[1], 0.51f, 1e-5f);
  EXPECT_NEAR(sensed.values[2], 7.9f, 1e-4f);
  EXPECT_EQ(sensed.values[3], 0);
}

TEST(DepthSensor, IsAFunctionOfTheSeedAndNotOfThreads) {
  const SquareBeforeWall scene;
  const Image mirrors(width, height, 1, 0.2f);
  const auto with = [&](std::size_t threads, std::uint64_t seed) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return sensed_depth(scene.depth, scene.normals, mirrors, camera, {}, seed).values;
  };
  const std::vector<float> one = with(1, 7);
  EXPECT_EQ(one, with(4, 7));
  EXPECT_NE(one, with(1, 8));
}

// What the room is for: normals of what a sensor gives are near the true ones.
TEST(DepthSensor, ItsNormalsAreNearTheTruth) {
  for (const double distance : {1.0, 2.0, 3.5}) {
    const Plane plane(40, 60, distance);
    const Image sensed = sensed_depth(plane.depth, plane.normals, camera, {}, 4);
    const Image normals = normals_from_depth(sensed, camera);
    std::vector<double> angles;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vector3d found = test::normal_at(normals, x, y);
        if (!found.isZero()) angles.push_back(test::degrees_between(found, test::slanted(40, 60)));
      }
    }
    EXPECT_GT(static_cast<double>(angles.size()), 0.95 * (1 - share_lost(sensed)) * width * height);
    std::ranges::nth_element(angles, angles.begin() + std::ssize(angles) / 2);
    EXPECT_LT(angles[angles.size() / 2], 3) << distance;
  }
}

TEST(DepthSensor, RefusesWhatDoesNotFit) {
  const Image depth(4, 4, 1, 1), normals = normals_like(Vector3d::UnitZ(), 4, 4);
  EXPECT_THROW(sensed_depth(depth, Image(4, 3, 3), camera, {}, 1), CheckFailed);
  EXPECT_THROW(sensed_depth(depth, normals, Image(4, 4, 3), camera, {}, 1), CheckFailed);
  DepthSensor sensor;
  sensor.grazing_to = sensor.grazing_from;
  EXPECT_THROW(sensed_depth(depth, normals, camera, sensor, 1), CheckFailed);
}

}  // namespace
}  // namespace partwise
