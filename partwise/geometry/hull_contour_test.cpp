#include "partwise/geometry/hull_contour.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/marching_cubes.h"
#include "partwise/geometry/outward_simplify.h"
#include "partwise/geometry/solid_angle.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/geometry/topology.h"
#include "partwise/geometry/triangle_crossing.h"

namespace partwise {
namespace {

// Every edge passed once each way: closed and manifold.
void expect_manifold(const Mesh& mesh) {
  for_each_edge(sorted_half_edges(mesh), [](std::span<const HalfEdge> edge) {
    ASSERT_EQ(edge.size(), 2u);
    EXPECT_NE(edge[0].forward, edge[1].forward);
  });
}

// All 256 signs of a cube's corners meet all kinds of neighbours in random samples.
TEST(MarchingCubes, IsClosedAndManifoldWhateverTheSigns) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> value(-1, 1);
  for (int round = 0; round < 20; ++round) {
    SampleGrid grid{.size = {12, 10, 11}, .low = Point(-1, 2, 3), .spacing = 0.5, .values = {}};
    grid.values.assign(grid.index(0, 0, grid.size[2]), 1);
    for (int k = 1; k + 1 < grid.size[2]; ++k)
      for (int j = 1; j + 1 < grid.size[1]; ++j)
        for (int i = 1; i + 1 < grid.size[0]; ++i) grid.values[grid.index(i, j, k)] = value(random);
    const Mesh mesh = marching_cubes(grid);
    expect_manifold(mesh);
    EXPECT_GT(signed_volume(mesh), 0);
    // It winds once about inside samples, and not at all about others.
    for (int k = 0; k < grid.size[2]; k += 3)
      for (int j = 0; j < grid.size[1]; j += 2)
        for (int i = 0; i < grid.size[0]; ++i) {
          const Point at = grid.low + grid.spacing * Point(i, j, k);
          EXPECT_NEAR(solid_angle_winding(mesh, at), grid.values[grid.index(i, j, k)] < 0, 1e-6);
        }
  }
}

std::vector<Mesh> two_boxes(double gap) {
  return {test::box({0, 0, 0}, {1, 1, 1}), test::box({1 + gap, 0, 0}, {2 + gap, 1, 1})};
}

TEST(HullContour, IsTheExpandedUnion) {
  for (const double spacing : {0.1, 0.05, 0.025}) {
    const auto boxes = two_boxes(-0.3);
    const Mesh skin = hull_contour(boxes, {.distance = 0.1, .spacing = spacing});
    expect_manifold(skin);
    for (const Mesh& box : boxes) EXPECT_TRUE(encloses(skin, box));
    const double sharp = (1.7 + 0.2) * 1.2 * 1.2;
    EXPECT_LT(signed_volume(skin), sharp);
    EXPECT_GT(signed_volume(skin), sharp * (1 - 0.6 * spacing));  // bevelled, and cut at corners
  }
}

TEST(HullContour, SealsGapsAsWideAsAskedFor) {
  const auto components = [](double gap, double seal) {
    return face_components_by_vertex(hull_contour(two_boxes(gap), {.distance = 0.05, .spacing = 0.05, .seal = seal}))
        .count;
  };
  EXPECT_EQ(components(0.05, 0), 1);
  EXPECT_EQ(components(0.3, 0), 2);
  EXPECT_EQ(components(0.3, 0.2), 1);
  EXPECT_EQ(components(0.8, 0.2), 2);
}

// Six slabs around a room with a slit in a corner.
std::vector<Mesh> room(double slit) {
  return {test::box({0, 0, 0}, {0.1, 2, 2}), test::box({1.9, 0, 0}, {2, 2, 2 - slit}),
          test::box({0, 0, 0}, {2, 0.1, 2}), test::box({0, 1.9, 0}, {2, 2, 2}),
          test::box({0, 0, 0}, {2, 2, 0.1}), test::box({0, 0, 1.9}, {2 - slit, 2, 2})};
}

TEST(HullContour, FillsWhatCannotBeReached) {
  const ContourSettings settings{.distance = 0.05, .spacing = 0.05};
  EXPECT_GT(signed_volume(hull_contour(room(0), settings)), 8);
  EXPECT_LT(signed_volume(hull_contour(room(0.4), settings)), 6);
  // What is told to be solid is filled though the slit leads to it.
  ContourSettings told = settings;
  told.doubt = 0.3;
  told.is_solid = [](const Point& p) { return (p - Point(1, 1, 1)).cwiseAbs().maxCoeff() < 0.95; };
  EXPECT_GT(signed_volume(hull_contour(room(0.4), told)), 7.5);
}

TEST(HullContour, RefusesWhatIsNoLength) {
  EXPECT_THROW(hull_contour({}, {.distance = 1, .spacing = 1}), InputError);
  EXPECT_THROW(hull_contour(two_boxes(0), {.distance = 0, .spacing = 1}), InputError);
  EXPECT_THROW(hull_contour(two_boxes(0), {.distance = 1, .spacing = 1, .seal = -1}), InputError);
  EXPECT_THROW(hull_contour(two_boxes(0), {.distance = 1e-3, .spacing = 1e-3}), InputError);
}

TEST(SimplifyOutwards, KeepsInsideWhatWasInside) {
  const Mesh skin = hull_contour(two_boxes(-0.5), {.distance = 0.1, .spacing = 0.06});
  for (const int most : {400, 100, 30}) {
    const Mesh simple = simplify_outwards(skin, most);
    EXPECT_LE(simple.faces.rows(), most);
    expect_manifold(simple);
    EXPECT_FALSE(crosses_itself(simple));
    EXPECT_GE(signed_volume(simple), signed_volume(skin));
    EXPECT_LT(signed_volume(simple), 1.5 * signed_volume(skin));
    for (const auto& vertex : skin.vertices.rowwise()) {
      const Point inside = vertex + 1e-6 * (Point(0.75, 0.5, 0.5) - vertex);
      EXPECT_GT(solid_angle_winding(simple, inside), 0.99);
    }
  }
}

TEST(TriangleCrossing, AgreesWithWhereTheSegmentMeetsThePlane) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> side(-1, 1);
  const auto point = [&] { return Point(side(random), side(random), side(random)); };
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle t{point(), point(), point()};
    const Point p = point(), q = point();
    Eigen::Matrix3d equations;  // p + s (q - p) = a + u (b - a) + v (c - a)
    equations << (q - p).transpose(), (t[0] - t[1]).transpose(), (t[0] - t[2]).transpose();
    const Eigen::Vector3d x = equations.partialPivLu().solve((t[0] - p).transpose());
    const double least = std::min({x[0], 1 - x[0], x[1], x[2], 1 - x[1] - x[2]});
    if (std::abs(least) < 1e-9) continue;
    EXPECT_EQ(segment_crosses_triangle(p, q, t), least > 0);
    crossing += least > 0;
  }
  EXPECT_GT(crossing, 500);
}

TEST(TriangleCrossing, EnclosingNeedsAllOfTheMesh) {
  const Mesh small = test::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}), large = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(encloses(large, small));
  EXPECT_FALSE(encloses(small, large));
  EXPECT_FALSE(encloses(large, test::box({0.5, 0.5, 0.5}, {1.5, 0.8, 0.8})));
  EXPECT_FALSE(encloses(large, test::box({2, 2, 2}, {3, 3, 3})));
  EXPECT_FALSE(encloses(large, test::box({-1, 0.4, 0.4}, {2, 0.6, 0.6})));  // all of its vertices outside
  EXPECT_NEAR(solid_angle_winding(large, Point(0.5, 0.5, 0.5)), 1, 1e-12);
  EXPECT_NEAR(solid_angle_winding(large, Point(1.5, 0.5, 0.5)), 0, 1e-12);
}

}  // namespace
}  // namespace partwise
