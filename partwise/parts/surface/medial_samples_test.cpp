#include "partwise/parts/surface/medial_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

double farthest(const MedialSamples& samples, const std::function<double(const Point&)>& from_axis) {
  double most = 0;
  for (const auto& point : samples.points.rowwise()) most = std::max(most, from_axis(point));
  return most;
}

TEST(MedialSamples, OfABallAreItsCentre) {
  const MedialSamples samples = medial_samples(test::sphere(2, 20), {.spacing = 0.2});
  EXPECT_GE(samples.points.rows(), 300);
  EXPECT_LE(farthest(samples, [](const Point& p) { return p.norm(); }), 0.03);
  for (const double radius : samples.radii) EXPECT_NEAR(radius, 2, 0.03);
}

TEST(MedialSamples, OfATorusAreTheCircleInItsMiddle) {
  const MedialSamples samples = medial_samples(test::torus(2, 0.7, 48, 24), {.spacing = 0.2});
  EXPECT_GE(samples.points.rows(), 1000);
  const auto from_circle = [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 2, p[2]); };
  EXPECT_LE(farthest(samples, from_circle), 0.03);
}

TEST(MedialSamples, OfABoxAreEquallyFarFromTwoOfItsSides) {
  const Point high(6, 4, 2);
  const MedialSamples samples = medial_samples(test::box({0, 0, 0}, high), {.spacing = 0.15});
  EXPECT_GE(samples.points.rows(), 300);
  double near_middle = 0;
  const auto from_axis = [&](const Point& p) {
    double sides[6];
    for (int axis = 0; axis < 3; ++axis) sides[2 * axis] = p[axis], sides[2 * axis + 1] = high[axis] - p[axis];
    std::sort(sides, sides + 6);
    EXPECT_GT(sides[0], 0);
    if (std::abs(p[2] - 1) < 0.02) near_middle += 1;
    return (sides[1] - sides[0]) / 2;  // a step towards the farther side by this much makes them equal
  };
  EXPECT_LE(farthest(samples, from_axis), 0.1);
  EXPECT_GE(near_middle, 0.3 * static_cast<double>(samples.points.rows()));  // the sheet between the large sides
}

TEST(MedialSamples, BallsAreEmptyAndScaleWithTheMesh) {
  Mesh mesh = test::dumbbell(40, 20);
  const MedialSamples samples = medial_samples(mesh);
  ASSERT_GE(samples.points.rows(), 300);
  const SurfaceQuery surface(mesh);
  for (Eigen::Index i = 0; i < samples.points.rows(); ++i) {
    EXPECT_TRUE(surface.contains(samples.points.row(i)));
    EXPECT_GE(surface.distance(samples.points.row(i)), 0.949 * samples.radii[static_cast<std::size_t>(i)]);
  }
  mesh.vertices = (mesh.vertices * 8).rowwise() + Point(1, 2, 3);  // a power of two: nothing is rounded otherwise
  const MedialSamples scaled = medial_samples(mesh);
  ASSERT_EQ(scaled.points.rows(), samples.points.rows());
  EXPECT_LE(((samples.points * 8).rowwise() + Point(1, 2, 3) - scaled.points).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(MedialSamples, SettingsOutOfRangeAreRefused) {
  const Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(medial_samples(mesh, {.spacing = 0.001}), InputError);
  EXPECT_THROW(medial_samples(mesh, {.least_angle = 4}), InputError);
  EXPECT_THROW(medial_samples(mesh, {.most_overlap = 0}), InputError);
  EXPECT_THROW(medial_samples(Mesh{Vertices::Zero(3, 3), Faces{{0, 1, 2}}}), InputError);
}

}  // namespace
}  // namespace partwise
