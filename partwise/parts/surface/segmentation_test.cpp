#include "partwise/parts/surface/segmentation.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "partwise/base/error.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/segmentation_measures.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

// Which of the two balls or the rod of test::dumbbell each face belongs to.
std::vector<int> dumbbell_parts(const Mesh& mesh) {
  const Eigen::VectorXd heights = face_means(mesh, mesh.vertices.col(2));
  std::vector<int> parts;
  for (double z : heights) parts.push_back(std::abs(z) < 1.5 - std::sqrt(1 - 0.25 * 0.25) ? 0 : z < 0 ? 1 : 2);
  return parts;
}

TEST(Segmentation, CutsADumbbellAsPeopleWould) {
  const Mesh mesh = test::dumbbell(60, 40);
  for (const auto feature : {SurfaceFeature::shape_diameter, SurfaceFeature::visibility,
                             SurfaceFeature::visibility_average, SurfaceFeature::visibility_strong}) {
    const Segmentation result = segment(mesh, {.feature = feature, .clusters = 2});
    EXPECT_EQ(result.parts, 3);
    EXPECT_LT(SegmentationComparison(mesh, result.labels).against(dumbbell_parts(mesh)).rand_error, 0.03);
  }
}

TEST(Segmentation, TakesTheFittedPairUnlessToldOtherwise) {
  const Mesh mesh = test::dumbbell(20, 12);
  const Segmentation fitted = segment(mesh, {.borders = Borders::plain});
  EXPECT_EQ(fitted.clusters, fitted_clusters);
  const Eigen::VectorXd in_a_ball = (face_means(mesh, mesh.vertices.col(2)).array().abs() > 0.8).cast<double>();
  EXPECT_EQ(segment_values(mesh, in_a_ball).smoothness, fitted_smoothness);
  const Segmentation told = segment(mesh, {.clusters = fitted.clusters, .smoothness = fitted.smoothness});
  EXPECT_EQ(told.labels, fitted.labels);
  EXPECT_EQ(segment(mesh, {.clusters = 1}).parts, 1);
  EXPECT_EQ(segment(mesh, {.clusters = 2, .smoothness = 1e6}).parts, 1);
  EXPECT_THROW(segment(mesh, {.clusters = -1}), InputError);
}

TEST(Segmentation, LearntBordersCutADumbbellAsPeopleWould) {
  const Mesh mesh = test::dumbbell(60, 40);
  const Segmentation result = segment(mesh);
  EXPECT_EQ(result.borders, Borders::learnt);
  EXPECT_EQ(result.parts, 3);
  EXPECT_LT(SegmentationComparison(mesh, result.labels).against(dumbbell_parts(mesh)).rand_error, 0.05);
  EXPECT_EQ(segment(test::sphere(1, 20)).parts, 1);
}

TEST(Segmentation, ManyComponentsArePiecesEach) {
  const int count = 60000;  // whose square no int holds
  Mesh mesh{Vertices(3 * count, 3), Faces(count, 3)};
  for (int f = 0; f < count; ++f) {
    mesh.vertices.middleRows<3>(3 * f) << f, 0, 0, f + 0.5, 0, 0, f, 0.5, 0;
    mesh.faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  const Eigen::VectorXd values = Eigen::VectorXd::Ones(count);
  EXPECT_EQ(segmentation_pieces(mesh, values, values).count, count);
}

TEST(Segmentation, LearntBordersGoWithAveragedVisibilityAlone) {
  const Mesh mesh = test::dumbbell(20, 12);
  EXPECT_EQ(segment(mesh, {.feature = SurfaceFeature::shape_diameter}).borders, Borders::plain);
  EXPECT_EQ(segment(mesh, {.smoothness = 24}).borders, Borders::plain);
  EXPECT_THROW(segment(mesh, {.borders = Borders::learnt, .clusters = 8}), InputError);
  EXPECT_THROW(segment(mesh, {.feature = SurfaceFeature::shape_diameter, .borders = Borders::learnt}), InputError);
}

TEST(Segmentation, AFittedSmoothnessThatLeavesAMeshWholeIsHalved) {
  // A ball with a small cap of another value, whose border costs more than it is worth.
  const Mesh mesh = test::sphere(1, 40);
  const Eigen::VectorXd heights = face_means(mesh, mesh.vertices.col(2));
  const Eigen::VectorXd values = (heights.array() > 0.985).cast<double>();
  EXPECT_EQ(segment_values(mesh, values, {.smoothness = fitted_smoothness}).parts, 1);
  const Segmentation halved = segment_values(mesh, values);
  EXPECT_EQ(halved.parts, 2);
  EXPECT_LT(halved.smoothness, fitted_smoothness);
  EXPECT_EQ(segment_values(mesh, Eigen::VectorXd::Ones(mesh.faces.rows())).parts, 1);
}

TEST(Segmentation, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = test::dumbbell(40, 24);
  const Segmentation many = segment(mesh);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Segmentation single = segment(mesh);
  EXPECT_EQ(single.labels, many.labels);
  EXPECT_EQ(single.values, many.values);
}

TEST(Segmentation, StopsWhenAskedTo) {
  const Progress stop{.report = {}, .cancelled = [] { return true; }};
  EXPECT_THROW(segment(test::sphere(1, 8), {}, stop), Cancelled);
}

}  // namespace
}  // namespace partwise
