#include "partwise/geometry/hull_simplify.h"

#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

using test::Cloud;

// The promises of the header; returns the volume over the hull's.
double checked_growth(const Mesh& hull, int max_vertices) {
  const Mesh simple = simplify_hull(hull, max_vertices);
  EXPECT_LE(simple.vertices.rows(), max_vertices);
  test::expect_closed_sphere(simple);
  const double size = (hull.vertices.colwise().maxCoeff() - hull.vertices.colwise().minCoeff()).norm();
  const double rounding = 1e-15 * hull.vertices.cwiseAbs().maxCoeff();
  EXPECT_LE(test::largest_excess(simple, simple.vertices), 1e-12 * size + rounding) << "not convex";
  const auto planes = hull_planes(simple);
  for (const auto& plane : planes.rowwise())
    EXPECT_LE((hull.vertices * plane.head<3>().transpose()).maxCoeff() - plane[3], 1e-12 * size + rounding);
  return signed_volume(simple) / signed_volume(hull);
}

struct Case {
  Cloud kind;
  int points;
  double growth[5];  // largest volume, as a share of the hull's, at 60, 32, 16, 8 and 4 vertices
};

class SimplifyHull : public testing::TestWithParam<Case> {};

TEST_P(SimplifyHull, EnclosesWithLittleMoreVolume) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const Mesh hull = convex_hull(test::cloud(GetParam().kind, GetParam().points, random), 1e-9).mesh;
    const int vertices[] = {60, 32, 16, 8, 4};
    for (int i = 0; i < 5; ++i) {
      const double growth = checked_growth(hull, vertices[i]);
      EXPECT_GE(growth, 1);
      EXPECT_LE(growth, GetParam().growth[i]) << vertices[i] << " vertices of " << hull.vertices.rows();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds, SimplifyHull,
                         testing::Values(Case{Cloud::sphere, 500, {1.06, 1.12, 1.28, 1.85, 4}},
                                         Case{Cloud::ball, 4000, {1.06, 1.12, 1.28, 1.85, 4}},
                                         Case{Cloud::box, 4000, {1.01, 1.02, 1.1, 1.3, 8}},
                                         Case{Cloud::elongated, 500, {1.06, 1.12, 1.28, 1.85, 4}},
                                         Case{Cloud::slab, 4000, {1.01, 1.02, 1.1, 1.3, 8}}));

TEST(SimplifyHull, PlatonicSolidsDownToATetrahedron) {
  Vertices octahedron(6, 3);
  octahedron << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  const Mesh solids[] = {convex_hull(octahedron, 1e-9).mesh, test::box({-1, -1, -1}, {1, 1, 1}),
                         test::box({0, 0, 0}, {100, 1, 0.01})};
  for (const Mesh& solid : solids)
    for (int vertices = 4; vertices < solid.vertices.rows(); ++vertices) EXPECT_LE(checked_growth(solid, vertices), 10);
}

TEST(SimplifyHull, CutCornersGrowBackToTheCube) {
  // A cube with its corners cut off by a little has 24 vertices; the cube itself is the smallest hull of 8.
  Vertices points(24, 3);
  int count = 0;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) {
      Point corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      corner[k] *= 0.9;
      points.row(count++) = corner;
    }
  const Mesh hull = convex_hull(points, 1e-9).mesh;
  EXPECT_NEAR(checked_growth(hull, 8) * signed_volume(hull), 8, 1e-9);
}

TEST(SimplifyHull, PrismsDiscsAndRoundedPoints) {
  std::mt19937_64 random(2);
  for (double height : {1e-6, 0.1, 10.0})
    for (int sides : {7, 64, 200}) {
      Vertices points(2 * sides, 3);
      for (int i = 0; i < 2 * sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i % sides) / sides;
        points.row(i) << std::cos(angle), std::sin(angle), i < sides ? 0 : height;
      }
      const Mesh hull = convex_hull((points * test::random_rotation(random)).cast<float>().cast<double>(), 1e-9).mesh;
      for (int vertices : {4, 5, 6, 7, 8, 13, 30}) EXPECT_LE(checked_growth(hull, vertices), 12);
    }
}

TEST(SimplifyHull, FarFromTheOriginAndTiny) {
  std::mt19937_64 random(3);
  for (double scale : {1e-9, 1.0, 1e9}) {
    const Vertices points = scale * (test::cloud(Cloud::ball, 500, random).rowwise() + Point(1e4, 0, 0));
    EXPECT_LE(checked_growth(convex_hull(points, 1e-9 * scale).mesh, 20), 1.25);
  }
}

TEST(SimplifyHull, FewVerticesAreReturnedAsTheyAre) {
  const Mesh cube = test::box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(simplify_hull(cube, 8).vertices, cube.vertices);
  EXPECT_EQ(simplify_hull(cube, 8).faces, cube.faces);
  EXPECT_THROW(simplify_hull(cube, 3), InputError);
}

TEST(SimplifyHull, SameBytesTwice) {
  std::mt19937_64 random(4);
  const Mesh hull = convex_hull(test::cloud(Cloud::sphere, 300, random), 1e-9).mesh;
  EXPECT_EQ(simplify_hull(hull, 24).vertices, simplify_hull(hull, 24).vertices);
}

}  // namespace
}  // namespace partwise
