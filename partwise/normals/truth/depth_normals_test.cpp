#include "partwise/normals/truth/depth_normals.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/test_scenes.h"
#include "partwise/base/error.h"
#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

using Eigen::Vector3d;
using test::degrees_between;
using test::depth_picture;
using test::normal_at;
using test::PlaneDepth;
using test::small_camera;
using test::small_height;
using test::small_width;
using test::SphereDepth;

constexpr double kinect_step = 1 / (8 * 580 * 0.075);  // of inverse depth

DepthNormalSettings exact(int radius) {
  DepthNormalSettings settings;
  settings.noise = 0;
  settings.least_radius = radius;
  return settings;
}

Image small_picture(const auto& depth) { return depth_picture(small_camera, small_width, small_height, depth); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(DepthNormals, PlanesAreExactAtAnySlant) {
  for (const double slant : {0.0, 10.0, 35.0, 60.0, 75.0, 84.0}) {
    for (double towards = 0; towards < 360; towards += 45) {
      SCOPED_TRACE(testing::Message() << slant << " degrees towards " << towards);
      const Vector3d truth = test::slanted(slant, towards);
      const Image depth = small_picture(PlaneDepth{truth, 1.5});
      const Image normals = normals_from_depth(depth, small_camera, exact(10));
      int compared = 0;
      for (int y = 0; y < small_height; ++y) {
        for (int x = 0; x < small_width; ++x) {
          const Vector3d ray = small_camera.ray(x, y);
          if (depth.pixel(x, y)[0] == 0 || -ray.normalized().dot(truth) < std::cos(1.45)) continue;
          const Vector3d found = normal_at(normals, x, y);
          if (found.norm() == 0) continue;  // beside the horizon, steps are steeper than surfaces are taken to be
          ++compared;
          EXPECT_LT((found - truth).norm(), 1e-6) << x << ' ' << y;
        }
      }
      EXPECT_GT(compared, small_width * small_height / 4);
    }
  }
}

TEST(DepthNormals, OfASphereAreItsOwn) {
  const SphereDepth sphere{2, 0.5};
  const Image normals = normals_from_depth(small_picture(sphere), small_camera, exact(2));
  int compared = 0;
  for (int y = 0; y < small_height; ++y) {
    for (int x = 0; x < small_width; ++x) {
      const Vector3d ray = small_camera.ray(x, y);
      const double depth = sphere(ray);
      if (depth == 0) {
        EXPECT_EQ(normal_at(normals, x, y).norm(), 0);
        continue;
      }
      const Vector3d truth = (depth * ray - Vector3d(0, 0, -2)) / 0.5;
      if (-truth.dot(ray.normalized()) < 0.6) continue;
      ++compared;
      EXPECT_LT(degrees_between(normal_at(normals, x, y), truth), 0.8) << x << ' ' << y;
      EXPECT_NEAR(normal_at(normals, x, y).norm(), 1, 1e-6);
    }
  }
  EXPECT_GT(compared, 1000);
}

// To the right they look right, above up, whatever the lens.
TEST(DepthNormals, ASphereIsSeenAsTheRendererSeesIt) {
  const RenderMesh ball{test::sphere(160), {}, 180};
  const RenderScene scene({&ball, 1});
  Camera camera;
  camera.position = Point(0, 0, 4);
  camera.half_height = 0.3;
  const GBuffer seen = scene.view(camera, {97, 81, 1});
  const Image truth = seen.normal_image();
  const Image found = normals_from_depth(seen.depth_image(), pinhole_camera(camera, 97, 81), exact(2));
  EXPECT_GT(normal_at(found, 72, 40).x(), 0.55);
  EXPECT_GT(normal_at(found, 48, 16).y(), 0.55);
  EXPECT_GT(normal_at(found, 48, 40).z(), 0.9999);
  std::vector<double> angles;
  for (int y = 0; y < 81; ++y) {
    for (int x = 0; x < 97; ++x) {
      const Vector3d n = normal_at(truth, x, y);
      if (n.dot(Vector3d::UnitZ()) > 0.5) angles.push_back(degrees_between(normal_at(found, x, y), n));
    }
  }
  EXPECT_GT(angles.size(), 1500u);
  EXPECT_LT(median(angles), 0.5);
  EXPECT_LT(std::ranges::max(angles), 4);
}

TEST(DepthNormals, SidesOfAStepAreNotMixed) {
  // A slanted plane before a differently slanted one; the border runs obliquely.
  const PlaneDepth near{test::slanted(30, 20), 1.5}, far{test::slanted(50, 200), 1.62};
  const auto is_near = [](const Vector3d& ray) { return ray.x() + 0.4 * ray.y() < 0.02; };
  const Image depth = small_picture([&](const Vector3d& ray) { return is_near(ray) ? near(ray) : far(ray); });
  const Image normals = normals_from_depth(depth, small_camera, exact(4));
  int compared = 0;
  for (int y = 0; y < small_height; ++y) {
    for (int x = 0; x < small_width; ++x) {
      const Vector3d ray = small_camera.ray(x, y);
      if (std::abs(near(ray) - far(ray)) < 0.04)
        continue;  // three pixels' width: where the planes cross, it is no step
      ++compared;
      EXPECT_LT((normal_at(normals, x, y) - (is_near(ray) ? near : far).normal).norm(), 1e-5) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(DepthNormals, ACreaseIsNoStep) {
  // A corner of 90 degrees, the edge towards the viewer: exact where the window is all on one side, and known
  // everywhere.
  const PlaneDepth left{test::slanted(45, 180), 2}, right{test::slanted(45, 0), 2};
  const Image depth = small_picture([&](const Vector3d& ray) { return std::max(left(ray), right(ray)); });
  const Image normals = normals_from_depth(depth, small_camera, exact(3));
  for (int y = 0; y < small_height; ++y) {
    for (int x = 0; x < small_width; ++x) {
      const Vector3d found = normal_at(normals, x, y);
      EXPECT_NEAR(found.norm(), 1, 1e-6);
      if (std::abs(x - small_camera.centre_x) > 4) {
        EXPECT_LT((found - (x < small_camera.centre_x ? left : right).normal).norm(), 1e-5) << x << ' ' << y;
      }
    }
  }
  const int edge = 47;
  EXPECT_GT(normal_at(normals, edge, 30).z(), 0.9);  // both sides share the window
}

TEST(DepthNormals, OfQuantisedDepthStayNearTheTruth) {
  const PinholeCamera camera{525, 525, 159.5, 119.5};
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.2 * kinect_step);
  for (const double distance : {1.0, 2.0, 4.0}) {
    for (const double slant : {0.0, 40.0, 65.0}) {
      const PlaneDepth plane{test::slanted(slant, 70), distance};
      const Image depth = depth_picture(camera, 320, 240, [&](const Vector3d& ray) {
        return 1 / (kinect_step * std::round((1 / plane(ray) + noise(random)) / kinect_step));
      });
      const Image normals = normals_from_depth(depth, camera);
      std::vector<double> angles;
      for (int y = 20; y < 220; ++y) {
        for (int x = 20; x < 300; ++x) {
          ASSERT_NE(normal_at(normals, x, y).norm(), 0) << x << ' ' << y;
          angles.push_back(degrees_between(normal_at(normals, x, y), plane.normal));
        }
      }
      EXPECT_LT(median(angles), 3) << distance << " m, slanted by " << slant;
    }
  }
}

// The plane through the points of a window that is nearest to them, by the smallest eigenvector.
Vector3d nearest_plane(const Image& depth, const PinholeCamera& camera, int x, int y, int radius) {
  std::vector<Vector3d> points;
  Vector3d mean = Vector3d::Zero();
  for (int j = y - radius; j <= y + radius; ++j) {
    for (int i = x - radius; i <= x + radius; ++i) {
      points.emplace_back(static_cast<double>(depth.pixel(i, j)[0]) * camera.ray(i, j));
      mean += points.back() / std::pow(2 * radius + 1, 2);
    }
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& each : points) scatter += (each - mean) * (each - mean).transpose();
  const Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  return normal.dot(mean) < 0 ? normal : -normal;
}

TEST(DepthNormals, AgreeWithThePlaneNearestToThePoints) {
  // A hilly ground with a little noise.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2e-5);
  const Image depth = small_picture([&](const Vector3d& ray) {
    return 2 + 0.06 * std::sin(9 * ray.x()) + 0.05 * std::cos(11 * ray.y() + 2 * ray.x()) + noise(random);
  });
  const Image normals = normals_from_depth(depth, small_camera, exact(3));
  std::vector<double> angles;
  for (int y = 3; y < small_height - 3; ++y) {
    for (int x = 3; x < small_width - 3; ++x) {
      angles.push_back(degrees_between(normal_at(normals, x, y), nearest_plane(depth, small_camera, x, y, 3)));
    }
  }
  EXPECT_LT(median(angles), 0.1);
  EXPECT_LT(std::ranges::max(angles), 0.6);
}

TEST(DepthNormals, BearRoundedDepthBetterThanThePlaneNearestToThePoints) {
  const PinholeCamera camera{525, 525, 79.5, 59.5};
  const PlaneDepth plane{test::slanted(40, 70), 3.5};
  const Image depth = depth_picture(camera, 160, 120, [&](const Vector3d& ray) {
    return 1 / (kinect_step * std::round(1 / plane(ray) / kinect_step));
  });
  DepthNormalSettings settings;
  settings.least_radius = settings.most_radius = 5;
  const Image normals = normals_from_depth(depth, camera, settings);
  std::vector<double> ours, theirs;
  for (int y = 5; y < 115; ++y) {
    for (int x = 5; x < 155; ++x) {
      ours.push_back(degrees_between(normal_at(normals, x, y), plane.normal));
      theirs.push_back(degrees_between(nearest_plane(depth, camera, x, y, 5), plane.normal));
    }
  }
  EXPECT_LT(median(ours), 0.7 * median(theirs));
}

TEST(DepthNormals, AreUnknownWhereTheDepthIs) {
  Image depth = small_picture(PlaneDepth{test::slanted(20, 10), 1});
  depth.pixel(10, 10)[0] = 0;
  depth.pixel(20, 10)[0] = std::numeric_limits<float>::quiet_NaN();
  depth.pixel(30, 10)[0] = -1;
  for (int y = 39; y < 46; ++y) {
    for (int x = 49; x < 56; ++x) depth.pixel(x, y)[0] = x == 52 && y == 42 ? depth.pixel(x, y)[0] : 0;  // an island
  }
  const Image normals = normals_from_depth(depth, small_camera, exact(3));
  const Mask known = known_normals(normals);
  const auto is_known = [&](int x, int y) { return known.pixel(x, y)[0] == 1; };
  EXPECT_FALSE(is_known(10, 10) || is_known(20, 10) || is_known(30, 10) || is_known(52, 42) || is_known(49, 39));
  EXPECT_TRUE(is_known(11, 10) && is_known(10, 9) && is_known(48, 42));
  EXPECT_EQ(std::ranges::count(known.values, 1.0f), small_width * small_height - 3 - 49);
  EXPECT_LT((normal_at(normals, 11, 10) - test::slanted(20, 10)).norm(), 1e-4);  // gaps do not disturb
}

TEST(DepthNormals, AreUnknownWhereNoiseWouldDecide) {
  DepthNormalSettings settings;
  settings.most_radius = 2;
  const auto known_at = [&](double metres) {
    const Image normals = normals_from_depth(Image(9, 9, 1, static_cast<float>(metres)), small_camera, settings);
    return known_normals(normals).pixel(4, 4)[0] == 1;
  };
  // Expected, of a window of 5 x 5 and a plane that faces us: sqrt(120^2 + 130^2) / sqrt(50) noise, of 1 / distance.
  const double limit = 15 * std::numbers::pi / 180 * std::sqrt(50) / std::hypot(120, 130) / settings.noise;
  EXPECT_TRUE(known_at(0.99 * limit));
  EXPECT_FALSE(known_at(1.01 * limit));
}

TEST(DepthNormals, AreTheSameForAnyNumberOfThreads) {
  const Image depth = small_picture(SphereDepth{});
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return normals_from_depth(depth, small_camera).values;
  };
  const std::vector<float> one = with(1);
  EXPECT_EQ(one, with(2));
  EXPECT_EQ(one, with(4));
}

TEST(DepthNormals, RefusesWhatIsNoDepth) {
  EXPECT_THROW(normals_from_depth(Image(4, 4, 3), small_camera), CheckFailed);
  EXPECT_THROW(normals_from_depth(Image(4, 4, 1), {}), CheckFailed);
  EXPECT_THROW(normals_from_depth(Image(4, 4, 1), small_camera, exact(0)), CheckFailed);
}

}  // namespace
}  // namespace partwise
