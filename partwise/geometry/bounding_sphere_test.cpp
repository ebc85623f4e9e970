#include <numbers>

#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

using test::Cloud;

// Points as the corners of faces, three at a time, so that all are used.
Mesh soup(const Vertices& points) {
  Mesh mesh{points, Faces(points.rows(), 3)};
  for (int i = 0; i < mesh.faces.rows(); ++i) mesh.faces.row(i).setConstant(i);
  return mesh;
}

// The radius of the smallest of all spheres through 2, 3 or 4 points (centre in their affine hull) that enclose all.
double brute_force_radius(const Vertices& points) {
  const int n = static_cast<int>(points.rows());
  double best = std::numeric_limits<double>::infinity();
  for (int subset = 1; subset < 1 << n; ++subset) {
    std::vector<int> chosen;
    for (int i = 0; i < n; ++i)
      if (subset >> i & 1) chosen.push_back(i);
    const int m = static_cast<int>(chosen.size()) - 1;
    if (m > 3) continue;
    Eigen::MatrixXd sides(m, 3);
    for (int i = 0; i < m; ++i) sides.row(i) = points.row(chosen[i + 1]) - points.row(chosen[0]);
    // The least-norm solution of 2 side . c = side . side lies in the span of the sides.
    const Eigen::VectorXd squares = 0.5 * sides.rowwise().squaredNorm();
    const Point centre =
        m == 0 ? Point(points.row(chosen[0]))
               : Point(points.row(chosen[0]) + sides.completeOrthogonalDecomposition().solve(squares).transpose());
    const Eigen::VectorXd distance = (points.rowwise() - centre).rowwise().norm();
    if (distance.maxCoeff() <= (points.row(chosen[0]) - centre).norm() + 1e-9)
      best = std::min(best, distance.maxCoeff());
  }
  return best;
}

TEST(BoundingSphere, ClosedForms) {
  EXPECT_NEAR(bounding_sphere(test::box({0, 0, 0}, {2, 4, 4})).radius, 3, 1e-14);
  EXPECT_TRUE(bounding_sphere(test::box({0, 0, 0}, {2, 4, 4})).centre.isApprox(Point(1, 2, 2), 1e-12));
  Vertices equilateral(3, 3), obtuse(3, 3), dot(1, 3);
  equilateral << 1, 0, 5, std::cos(2 * std::numbers::pi / 3), std::sin(2 * std::numbers::pi / 3), 5,
      std::cos(4 * std::numbers::pi / 3), std::sin(4 * std::numbers::pi / 3), 5;
  obtuse << -2, 0, 0, 2, 0, 0, 0, 1, 0;
  dot << 3, 4, 5;
  EXPECT_NEAR(bounding_sphere(soup(equilateral)).radius, 1, 1e-14);
  EXPECT_NEAR(bounding_sphere(soup(obtuse)).radius, 2, 1e-14);
  EXPECT_EQ(bounding_sphere(soup(dot)).radius, 0);
  EXPECT_EQ(bounding_sphere(soup(dot)).centre, Point(3, 4, 5));
  EXPECT_EQ(bounding_sphere({}).radius, 0);
}

TEST(BoundingSphere, VerticesWithoutFacesDoNotCount) {
  Mesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
  mesh.vertices.conservativeResize(9, 3);
  mesh.vertices.row(8) << 100, 0, 0;
  EXPECT_NEAR(bounding_sphere(mesh).radius, std::sqrt(3), 1e-14);
}

TEST(BoundingSphere, AgreesWithAllSupportSets) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    Vertices points = test::cloud(trial % 2 ? Cloud::box : Cloud::sphere, 1 + trial % 10, random);
    if (trial % 5 == 0) points = points.array().round();  // many equal, collinear and cospherical
    if (trial % 7 == 0) points.col(2).setZero();
    EXPECT_NEAR(bounding_sphere(soup(points)).radius, brute_force_radius(points), 1e-11) << trial;
  }
}

TEST(BoundingSphere, EnclosesAllAndTouchesSeveral) {
  std::mt19937_64 random(2);
  for (Cloud kind : {Cloud::ball, Cloud::box, Cloud::sphere, Cloud::elongated, Cloud::slab})
    for (double offset : {0.0, 1e6}) {
      const Vertices points = test::cloud(kind, 50000, random).rowwise() + Point(offset, 0, -offset);
      const Sphere sphere = bounding_sphere(soup(points));
      const Eigen::VectorXd distance = (points.rowwise() - sphere.centre).rowwise().norm();
      EXPECT_LE(distance.maxCoeff(), sphere.radius);
      // A sphere that is smallest has its centre in the hull of the points it touches: at least two.
      EXPECT_GE((distance.array() > sphere.radius - 1e-9 * (1 + offset * 1e-3)).count(), 2);
    }
}

}  // namespace
}  // namespace partwise
