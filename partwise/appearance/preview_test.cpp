#include "partwise/appearance/preview.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

double covered_pixels(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.pixel(x, y)[3];
  }
  return sum;
}

PreviewScene ball(double radius, const Point& centre) {
  PreviewScene scene;
  scene.points.push_back({centre, radius, {0.6f, 0.3f, 0.2f}});
  scene.ground = false;
  return scene;
}

Mesh box(const Point& low, const Point& high) {
  Vertices corners(8, 3);
  for (int i = 0; i < 8; ++i) {
    corners.row(i) << (i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z();
  }
  return convex_hull(corners, 1e-6).mesh;
}

TEST(Preview, SphereCoversTheAreaOfItsSilhouette) {
  const double radius = 1.7;
  const PreviewScene scene = ball(radius, {3, -2, 5});
  for (const double field_of_view : {0.0, 24.0, 60.0}) {
    PreviewView view;
    view.field_of_view = field_of_view;
    const PreviewCamera camera = frame_scene(scene, view, 1.2);
    const Image image = render_preview(scene, camera, {480, 400, 3});
    double pixels_radius = radius / camera.half_height * 200;
    if (field_of_view > 0) {  // the cone of tangents: sin = radius / distance
      const double distance = (camera.position - Point(3, -2, 5)).norm();
      pixels_radius = std::tan(std::asin(radius / distance)) / camera.half_height * 200;
    }
    EXPECT_NEAR(pixels_radius, 0.86 * 200, 0.01) << "framing, field of view " << field_of_view;
    const double area = std::numbers::pi * pixels_radius * pixels_radius;
    EXPECT_NEAR(covered_pixels(image) / area, 1, 1e-3) << "field of view " << field_of_view;
  }
}

TEST(Preview, FramingTouchesTheFrameAndCutsNothing) {
  PreviewScene scene;
  scene.meshes.push_back({box({-3, 0, -1}, {3, 1, 1}), {}});
  scene.ground = false;
  PreviewView view;
  view.fill = 1;
  const Image image = render_preview(scene, frame_scene(scene, view, 1.5), {300, 200, 2});
  double first = 0, last = 0, whole = covered_pixels(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < 2; ++x) first += image.pixel(x, y)[3], last += image.pixel(image.width - 1 - x, y)[3];
  }
  EXPECT_GT(first, 0);
  EXPECT_GT(last, 0);
  view.fill = 0.9;  // with a border, nothing more comes to light
  EXPECT_NEAR(covered_pixels(render_preview(scene, frame_scene(scene, view, 1.5), {300, 200, 2})) / (0.81 * whole), 1,
              0.01);
}

TEST(Preview, ColoursLandWhereTheyShould) {
  // Two boxes side by side, seen from the front: the left one red, the right one with a blue top and green elsewhere.
  PreviewScene scene;
  scene.meshes.push_back({box({-2, 0, 0}, {-1, 1, 1}), {}, {0.6f, 0.02f, 0.02f}});
  PreviewMesh right{box({1, 0, 0}, {2, 1, 1}), {}};
  for (Eigen::Index f = 0; f < right.mesh.faces.rows(); ++f) {
    const bool top = (right.mesh.vertices(right.mesh.faces.row(f), 1).array() == 1).all();
    right.face_colours.push_back(top ? Eigen::Vector3f(0.02f, 0.02f, 0.6f) : Eigen::Vector3f(0.02f, 0.6f, 0.02f));
  }
  scene.meshes.push_back(right);
  PreviewView view;
  view.azimuth = 0;
  view.elevation = 45;
  const PreviewCamera camera = frame_scene(scene, view, 2);
  const Image image = render_preview(scene, camera, {200, 100, 2});
  const auto strongest_at = [&](const Point& point) {
    const Eigen::Vector3d p = camera.axes * (point - camera.position).transpose();
    const double x = p.x() / -p.z() / camera.half_height / 2, y = p.y() / -p.z() / camera.half_height;
    const float* pixel = image.pixel(static_cast<int>(100 * (1 + x)), static_cast<int>(50 * (1 - y)));
    EXPECT_EQ(pixel[3], 1);
    return std::max_element(pixel, pixel + 3) - pixel;
  };
  EXPECT_EQ(strongest_at({-1.5, 0.5, 1}), 0);
  EXPECT_EQ(strongest_at({-1.5, 1, 0.5}), 0);
  EXPECT_EQ(strongest_at({1.5, 0.5, 1}), 1);
  EXPECT_EQ(strongest_at({1.5, 1, 0.5}), 2);
  const float* between = image.pixel(100, 20);
  EXPECT_EQ(between[0] + between[1] + between[2], 0);
}

TEST(Preview, LightFallsFromTheUpperLeftOntoTheGround) {
  PreviewScene scene;
  scene.meshes.push_back({box({-1, 0, -1}, {1, 2, 1}), {}});
  PreviewView view;
  view.azimuth = 0;
  view.fill = 0.5;
  const Image image = render_preview(scene, frame_scene(scene, view, 1), {120, 120, 2});
  double left = 0, right = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 30; ++x) left += image.pixel(x, y)[3], right += image.pixel(119 - x, y)[3];
  }
  EXPECT_GT(right, 2 * left);
  scene.ground = false;
  const Image bare = render_preview(scene, frame_scene(scene, view, 1), {120, 120, 2});
  EXPECT_EQ(bare.pixel(119, 80)[3], 0);
}

TEST(Preview, TubesRunAlongTheirPolyline) {
  PreviewScene scene;
  Vertices points(2, 3);
  points << 0, 0, 0, 4, 0, 0;
  scene.curves.push_back({points, 0.05, {0.1f, 0.1f, 0.5f}});
  scene.ground = false;
  PreviewView view;
  view.azimuth = 0;
  view.elevation = 0;
  view.field_of_view = 0;
  view.fill = 1;
  const PreviewCamera camera = frame_scene(scene, view, 4.1 / 0.2);  // the tube and its round ends fill the width
  const Image image = render_preview(scene, camera, {410, 20, 4});
  const double capsule = (4 * 0.1 + std::numbers::pi * 0.05 * 0.05) * 100 * 100;
  EXPECT_NEAR(covered_pixels(image) / capsule, 1, 0.005);
}

TEST(Preview, SameBytesForAnyNumberOfThreads) {
  PreviewScene scene;
  scene.meshes.push_back({box({-1, 0, -1}, {1, 2, 1}), {}});
  scene.meshes.push_back({box({0, 0, -1}, {1, 2, 2}), {}, {0.2f, 0.3f, 0.4f}});  // shares planes with the first
  scene.points.push_back({Point(0, 3, 0), 0.5, {0.5f, 0.4f, 0.3f}});
  const PreviewCamera camera = frame_scene(scene, {}, 1.2);
  std::vector<float> first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Image image = render_preview(scene, camera, {120, 100, 2});
    if (first.empty()) first = image.values;
    EXPECT_EQ(image.values, first) << threads;
  }
}

TEST(Preview, RefusesWhatItCannotDraw) {
  EXPECT_THROW(frame_scene({}, {}, 1), CheckFailed);
  const PreviewScene scene = ball(1, Point::Zero());
  const PreviewCamera camera = frame_scene(scene, {}, 1);
  EXPECT_THROW(render_preview(scene, camera, {0, 10, 1}), CheckFailed);
  EXPECT_THROW(render_preview(scene, camera, {10, 10, 0}), CheckFailed);
  PreviewScene wrong;
  wrong.meshes.push_back({box({0, 0, 0}, {1, 1, 1}), {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()}});
  EXPECT_THROW(render_preview(wrong, camera, {10, 10, 1}), CheckFailed);
}

}  // namespace
}  // namespace partwise
