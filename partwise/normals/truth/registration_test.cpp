#include "partwise/normals/truth/registration.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

#include "partwise/base/error.h"
#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::PlaneDepth;

constexpr PinholeCamera camera{100, 100, 31.5, 23.5};
constexpr int width = 64, height = 48;

RgbdFrame frame_of(float depth) {
  RgbdFrame frame{Image(width, height, 3), Image(width, height, 1, depth), camera};
  for (std::size_t i = 0; i < frame.colour.values.size(); ++i) {
    frame.colour.values[i] = static_cast<float>((i * 31) % 101) / 100;
  }
  return frame;
}

TEST(Registration, OfOneCameraChangesNothing) {
  const RgbdFrame frame = frame_of(1.5f);
  DepthRig rig;
  rig.depth_camera = rig.colour_camera = camera;
  const RgbdFrame same = registered_frame(frame, rig);
  EXPECT_EQ(same.depth.values, frame.depth.values);
  for (std::size_t i = 0; i < frame.colour.values.size(); ++i) {
    EXPECT_NEAR(same.colour.values[i], frame.colour.values[i], 1e-5f);
  }
}

TEST(Registration, CamerasThatStandAsideSeeNearThingsShifted) {
  RgbdFrame frame = frame_of(2);
  frame.depth.pixel(30, 20)[0] = 1;  // before the wall
  DepthRig rig;
  rig.depth_camera = rig.colour_camera = camera;
  rig.offset = Vector3d(0.06, 0.04, 0);  // the colour camera stands to the left, and lower
  const RgbdFrame seen = registered_frame(frame, rig);
  EXPECT_EQ(seen.depth.pixel(36, 16)[0], 1);  // by 100 * 0.06 / 1 to the right, and by 4 up
  EXPECT_EQ(seen.depth.pixel(33, 18)[0], 0);  // where it hid the wall
  EXPECT_EQ(seen.depth.pixel(34, 18)[0], 2);
  EXPECT_EQ(seen.depth.pixel(2, 20)[0], 0);  // left of what the depth camera saw
  EXPECT_EQ(seen.depth.pixel(3, 20)[0], 2);
  int near = 0;
  for (const float z : seen.depth.values) near += z == 1 ? 1 : 0;
  EXPECT_EQ(near, 1);
}

TEST(Registration, LensesAreUndone) {
  const DepthRig rig = nyu_rig();
  for (const LensDistortion& lens : {rig.depth_lens, rig.colour_lens}) {
    double most = 0;
    for (double x = -0.6; x <= 0.6; x += 0.1) {
      for (double y = -0.45; y <= 0.45; y += 0.15) {
        const Vector2d point(x, y);
        EXPECT_LT((undistorted(lens, distorted(lens, point)) - point).norm(), 1e-8) << x << ' ' << y;
        most = std::max(most, (distorted(lens, point) - point).norm());
      }
    }
    EXPECT_GT(most, 2e-3);
  }
  // A radial term moves along the radius, by that factor.
  const Vector2d moved = distorted({{0.1, 0, 0}, {}}, {0.3, 0.4});
  EXPECT_LT((moved - 1.025 * Vector2d(0.3, 0.4)).norm(), 1e-12);
  // Tangential terms, for a point on the axis.
  EXPECT_LT((distorted({{}, {0.01, 0.02}}, {0.5, 0}) - Vector2d(0.5 + 0.02 * 0.75, 0.01 * 0.25)).norm(), 1e-12);
}

// The depth of a slanted plane, through another lens and from another place, is that of the same plane.
TEST(Registration, APlaneStaysAPlaneInSpace) {
  const DepthRig rig = nyu_rig();
  const PlaneDepth plane{test::slanted(35, 60), 1.4};
  RgbdFrame frame{Image(640, 480, 3, 0.25f), Image(640, 480, 1), rig.depth_camera};
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const Vector3d ray = rig.depth_camera.ray(x, y);
      const Vector2d point = undistorted(rig.depth_lens, {ray.x(), -ray.y()});
      frame.depth.pixel(x, y)[0] = static_cast<float>(plane({point.x(), -point.y(), -1}));
    }
  }
  const RgbdFrame seen = registered_frame(frame, rig);
  const Vector3d normal = rig.rotation * plane.normal;
  const double distance = -normal.dot(rig.rotation * Vector3d(0, 0, -plane.distance) + rig.offset);
  int compared = 0;
  for (int y = 60; y < 420; ++y) {
    for (int x = 60; x < 580; ++x) {
      const auto depth = static_cast<double>(seen.depth.pixel(x, y)[0]);
      if (depth == 0) continue;
      ++compared;
      const Vector3d ray = seen.camera.ray(x, y);
      // Off by what the plane changes within half a pixel.
      EXPECT_NEAR(-normal.dot(ray) * depth / distance, 1, 0.71 * depth / distance / seen.camera.focal_x)
          << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 0.97 * 360 * 520);
  EXPECT_NEAR(seen.colour.pixel(320, 240)[2], 0.25f, 1e-6f);
}

TEST(Registration, RefusesPicturesThatAreNoPair) {
  RgbdFrame frame = frame_of(1);
  frame.colour = Image(width, height + 1, 3);
  EXPECT_THROW(registered_frame(frame, nyu_rig()), CheckFailed);
}

}  // namespace
}  // namespace partwise
