#include "partwise/geometry/convex_hull.h"

#include <tbb/parallel_for.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

using test::Cloud;

double size_of(const Vertices& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

// The promises that hold for every input.
ConvexHull checked_hull(const Vertices& points, double minimum_thickness) {
  const ConvexHull hull = convex_hull(points, minimum_thickness);
  test::expect_closed_sphere(hull.mesh);
  const double scale = std::max({size_of(points), minimum_thickness, 1e-4 * points.cwiseAbs().maxCoeff()});
  EXPECT_LE(test::largest_excess(hull.mesh, points), 1e-12 * scale);
  EXPECT_LE(test::largest_excess(hull.mesh, hull.mesh.vertices), 1e-12 * scale);
  const auto planes = hull_planes(hull.mesh);
  for (const auto& plane : planes.rowwise()) {
    EXPECT_NEAR(plane.head<3>().norm(), 1, 1e-14);
    EXPECT_LE((points * plane.head<3>().transpose()).maxCoeff() - plane[3], 1e-12 * scale);
  }
  EXPECT_GT(hull.volume, 0);
  EXPECT_DOUBLE_EQ(hull.volume, signed_volume(hull.mesh));
  if (hull.thickened) {
    EXPECT_EQ(hull.source.size(), static_cast<std::size_t>(hull.mesh.vertices.rows()));
    const double moved = (hull.mesh.vertices - Vertices(points(hull.source, Eigen::all))).rowwise().norm().maxCoeff();
    EXPECT_LE(moved, 2 * minimum_thickness);
  } else {
    EXPECT_TRUE(std::ranges::is_sorted(hull.source));
    EXPECT_EQ(hull.mesh.vertices, Vertices(points(hull.source, Eigen::all)));
  }
  return hull;
}

double oracle_volume(const Vertices& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> corners;
  for (const auto& p : points.rowwise()) corners.emplace_back(p[0], p[1], p[2]);
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(corners.begin(), corners.end(), hull);
  return CGAL::to_double(CGAL::Polygon_mesh_processing::volume(hull));
}

TEST(ConvexHull, AgreesWithExactPredicatesOnRandomClouds) {
  std::mt19937_64 random(1);
  for (Cloud kind : {Cloud::ball, Cloud::box, Cloud::sphere, Cloud::elongated, Cloud::slab})
    for (int count : {4, 5, 8, 50, 300, 1000}) {
      const Vertices points = test::cloud(kind, count, random);
      const ConvexHull hull = checked_hull(points, 1e-9);
      EXPECT_FALSE(hull.thickened);
      EXPECT_NEAR(hull.volume, oracle_volume(points), 1e-12 * std::pow(size_of(points), 3));
    }
}

TEST(ConvexHull, AgreesWithExactPredicatesOnPointsRoundedToFloat) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 40; ++trial) {
    // A prism, a grid in a box and a sphere, turned and rounded: many points nearly on common planes, lines and
    // circles.
    const Eigen::Matrix3d turn = test::random_rotation(random);
    const int kind = trial % 3;
    Vertices points = test::cloud(Cloud::sphere, 600, random);
    if (kind < 2)
      for (int i = 0; i < 600; ++i) {
        const double angle = 2 * std::numbers::pi * (i % 60) / 60;
        if (kind == 0)
          points.row(i) << std::cos(angle), std::sin(angle), 0.3 * (i / 60);
        else
          points.row(i) << i % 10, i / 10 % 10, i / 100;
      }
    points = (points * turn).cast<float>().cast<double>();
    EXPECT_NEAR(checked_hull(points, 1e-9).volume, oracle_volume(points), 1e-12 * std::pow(size_of(points), 3));
  }
}

TEST(ConvexHull, NoiseOfEverySizeOnAPlaneUnderAnApex) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> side(-1, 1);
  for (double noise = 1e-17; noise < 1; noise *= 10) {
    Vertices points(400, 3);
    for (auto row : points.rowwise()) row << side(random), side(random), noise * side(random);
    points.row(0) << 0, 0, 0.5;
    points = (points * test::random_rotation(random)).eval();
    EXPECT_NEAR(checked_hull(points, 1e-9).volume, oracle_volume(points), 1e-12) << noise;
  }
}

TEST(ConvexHull, NearFlatSetsOfEveryThickness) {
  std::mt19937_64 random(4);
  for (double thickness = 1e-15; thickness < 1; thickness *= 10) {
    Vertices points = test::cloud(Cloud::box, 200, random);
    points.col(2) *= thickness;
    points = (points * test::random_rotation(random)).eval();
    const double minimum = 1e-6;
    const ConvexHull hull = checked_hull(points, minimum);
    EXPECT_EQ(hull.thickened, thickness < minimum / 2) << thickness;
    EXPECT_GT(hull.volume, 0.9 * minimum) << thickness;
  }
}

TEST(ConvexHull, KnownSolids) {
  Vertices tetrahedron(4, 3), octahedron(6, 3);
  tetrahedron << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  octahedron << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  EXPECT_NEAR(checked_hull(tetrahedron, 1e-6).volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(checked_hull(octahedron, 1e-6).volume, 4.0 / 3, 1e-15);
  EXPECT_NEAR(checked_hull(test::box_corners({1, 2, 3}, {2, 4, 6}), 1e-6).volume, 6, 1e-14);
}

TEST(ConvexHull, CubeWithAGridOfPointsInItAndOnItsFaces) {
  Vertices points(7 * 7 * 7, 3);
  for (int i = 0; i < points.rows(); ++i) points.row(i) << i % 7, i / 7 % 7, i / 49;
  const ConvexHull hull = checked_hull(points, 1e-6);
  EXPECT_EQ(hull.mesh.vertices.rows(), 8);
  EXPECT_DOUBLE_EQ(hull.volume, 216);
}

TEST(ConvexHull, PlanesOfSliversHoldTheWholeHull) {
  // A tetrahedron with a fifth corner next to the middle of an edge, moved by a rounding error in any direction.
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 100; ++trial) {
    Mesh hull{Vertices(5, 3), Faces(6, 3)};
    hull.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0, 0;
    hull.vertices.row(4) += 1e-15 * test::random_direction(random);
    hull.vertices = (hull.vertices * test::random_rotation(random)).eval();
    hull.faces << 0, 4, 1, 0, 2, 4, 4, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    for (const double slant : {1e-15, 0.02}) {  // a sliver; and one that is no sliver but looks inwards
      hull.vertices.row(4) += slant * (hull.vertices.row(2) - hull.vertices.row(4));
      if (slant > 1e-3) std::swap(hull.faces(0, 1), hull.faces(0, 2));
      const auto planes = hull_planes(hull);
      for (const auto& plane : planes.rowwise())
        EXPECT_LE((hull.vertices * plane.head<3>().transpose()).maxCoeff() - plane[3], 1e-14);
    }
  }
}

TEST(ConvexHull, CosphericalPointsOfARegularBall) {
  Vertices points(36 * 17 + 2, 3);
  int count = 0;
  for (int i = 1; i < 18; ++i)
    for (int j = 0; j < 36; ++j) {
      const double polar = std::numbers::pi * i / 18, azimuth = std::numbers::pi * j / 18;
      points.row(count++) << std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar);
    }
  points.row(count++) << 0, 0, 1;
  points.row(count++) << 0, 0, -1;
  const ConvexHull hull = checked_hull(points, 1e-6);
  EXPECT_EQ(hull.mesh.vertices.rows(), points.rows());
  EXPECT_NEAR(hull.volume, oracle_volume(points), 1e-12);
}

TEST(ConvexHull, FarFromTheOrigin) {
  std::mt19937_64 random(5);
  for (Cloud kind : {Cloud::ball, Cloud::box, Cloud::sphere}) {
    const Vertices points = test::cloud(kind, 300, random).rowwise() + Point(1e6, -1e6, 1e6);
    EXPECT_NEAR(checked_hull(points, 1e-4).volume, oracle_volume(points.rowwise() - points.row(0)), 1e-9);
  }
}

TEST(ConvexHull, FlatSetsAreThickenedByTheStatedAmount) {
  std::mt19937_64 random(6);
  const double t = 1e-3;
  Vertices square(5, 3), segment(3, 3), dot(1, 3), twice(2, 3), triangle(3, 3);
  square << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 0;
  segment << 0, 0, 0, 3, 0, 0, 1, 0, 0;
  dot << 1, 2, 3;
  twice << 1, 2, 3, 1, 2, 3;
  triangle << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Matrix3d turn = test::random_rotation(random);
    const Point shift = 10 * test::random_direction(random);
    const auto thick_volume = [&](const Vertices& points) {
      const ConvexHull hull = checked_hull((points * turn).rowwise() + shift, t);
      EXPECT_TRUE(hull.thickened);
      return hull.volume;
    };
    EXPECT_NEAR(thick_volume(square), 4 * t, 1e-12);
    EXPECT_NEAR(thick_volume(triangle), t / 2, 1e-12);
    EXPECT_NEAR(thick_volume(segment), 3 * t * t, 1e-12);
    EXPECT_NEAR(thick_volume(dot), t * t * t, 1e-12);
    EXPECT_NEAR(thick_volume(twice), t * t * t, 1e-12);
  }
}

TEST(ConvexHull, DuplicatePointsAreCountedOnce) {
  std::mt19937_64 random(7);
  const Vertices once = test::cloud(Cloud::sphere, 100, random);
  Vertices thrice(300, 3);
  thrice << once, once, once;
  const ConvexHull hull = checked_hull(thrice, 1e-6);
  EXPECT_EQ(hull.mesh.vertices.rows(), 100);
  EXPECT_NEAR(hull.volume, convex_hull(once, 1e-6).volume, 1e-14);
}

TEST(ConvexHull, TasksAtTheSameTimeGiveTheSameBytes) {
  std::mt19937_64 random(8);
  std::vector<Vertices> clouds;
  std::vector<Mesh> alone;
  for (int i = 0; i < 200; ++i) {
    clouds.push_back(test::cloud(i % 2 ? Cloud::sphere : Cloud::box, 20 + i, random));
    alone.push_back(convex_hull(clouds.back(), 1e-6).mesh);
  }
  std::vector<Mesh> together(clouds.size());
  tbb::parallel_for(std::size_t{0}, clouds.size(),
                    [&](std::size_t i) { together[i] = convex_hull(clouds[i], 1e-6).mesh; });
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(alone[i].vertices, together[i].vertices);
    EXPECT_EQ(alone[i].faces, together[i].faces);
  }
}

TEST(ConvexHull, NoPointsAreAnInputError) { EXPECT_THROW(convex_hull(Vertices(0, 3), 1e-6), InputError); }

}  // namespace
}  // namespace partwise
