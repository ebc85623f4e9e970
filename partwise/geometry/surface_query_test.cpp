#include "partwise/geometry/surface_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh both{Vertices(a.vertices.rows() + b.vertices.rows(), 3), Faces(a.faces.rows() + b.faces.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
  return both;
}

Mesh inside_out(Mesh mesh) {
  mesh.faces.col(1).swap(mesh.faces.col(2));
  return mesh;
}

Mesh soup(int faces, std::mt19937_64& random) {
  Mesh mesh{test::cloud(test::Cloud::box, 3 * faces, random), Faces(faces, 3)};
  for (int i = 0; i < 3 * faces; ++i) mesh.faces(i / 3, i % 3) = i;
  return mesh;
}

double segment_distance(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double t = ab.squaredNorm() > 0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

// The foot on the plane if it is inside all three edges, else the nearest edge.
double triangle_distance(const Point& p, const Point& a, const Point& b, const Point& c) {
  const double edges = std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
  const Point normal = (b - a).cross(c - a);
  if (normal.norm() == 0) return edges;
  const Point unit = normal.normalized();
  const bool inside =
      (b - a).cross(p - a).dot(unit) >= 0 && (c - b).cross(p - b).dot(unit) >= 0 && (a - c).cross(p - c).dot(unit) >= 0;
  return inside ? std::min(edges, std::abs((p - a).dot(unit))) : edges;
}

double brute_distance(const Mesh& mesh, const Point& p) {
  double least = 1e300;
  for (const auto& f : mesh.faces.rowwise())
    least = std::min(least,
                     triangle_distance(p, mesh.vertices.row(f[0]), mesh.vertices.row(f[1]), mesh.vertices.row(f[2])));
  return least;
}

TEST(SurfaceQuery, DistanceEqualsTheNearestOfAllFaces) {
  std::mt19937_64 random(1);
  for (int faces : {1, 2, 10, 100}) {
    const Mesh mesh = soup(faces, random);
    const SurfaceQuery surface(mesh);
    for (double reach : {1.0, 3.0, 100.0}) {
      const Vertices points = reach * test::cloud(test::Cloud::box, 200, random);
      for (const auto& p : points.rowwise()) {
        const double exact = brute_distance(mesh, p);
        EXPECT_NEAR(surface.distance(p), exact, 2e-6 * std::max(1.0, exact));
        EXPECT_NEAR(surface.distance(p, 0.5), std::min(0.5, exact), 2e-6);
      }
    }
  }
}

TEST(SurfaceQuery, SliversAreMeasuredLikeOtherFaces) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-17}) {
    Mesh mesh = soup(60, random);
    for (int f = 0; f < 60; ++f) {  // The third corner next to the line through the others.
      const Point a = mesh.vertices.row(3 * f), b = mesh.vertices.row(3 * f + 1);
      mesh.vertices.row(3 * f + 2) = a + unit(random) * (b - a) + width * test::random_direction(random);
    }
    const SurfaceQuery surface(mesh);
    const Vertices points = test::cloud(test::Cloud::box, 300, random);
    for (const auto& p : points.rowwise()) EXPECT_NEAR(surface.distance(p), brute_distance(mesh, p), 3e-6) << width;
  }
}

TEST(SurfaceQuery, DistanceToABoxInClosedForm) {
  const Mesh mesh = test::box(Point(-1, -2, -3), Point(1, 2, 3));
  const SurfaceQuery surface(mesh);
  EXPECT_NEAR(surface.distance(Point(0, 0, 0)), 1, 1e-6);
  EXPECT_NEAR(surface.distance(Point(4, 6, 3)), 5, 1e-5);
  EXPECT_NEAR(surface.distance(Point(1, 2, 3)), 0, 1e-6);
  EXPECT_EQ(surface.distance(Point(4, 6, 3), 2), 2);
}

TEST(SurfaceQuery, MovingKeepsTheAnswers) {
  SurfaceQuery surface(test::box(Point(-1, -1, -1), Point(1, 1, 1)));
  SurfaceQuery other = std::move(surface);
  EXPECT_TRUE(other.contains(Point(0.2, 0.3, 0.4)));
  surface = std::move(other);
  EXPECT_FALSE(surface.contains(Point(1.2, 0.3, 0.4)));
}

TEST(SurfaceQuery, WindingNumberOfConvexBodiesTellsInsideFromOutside) {
  std::mt19937_64 random(3);
  for (double offset : {0.0, 1e5}) {  // Far off, floats alone could not tell.
    Vertices cloud = test::cloud(test::Cloud::sphere, 60, random);
    cloud.rowwise() += Point(offset, -offset, 2 * offset);
    const Mesh mesh = convex_hull(cloud, 1e-9).mesh;
    const auto planes = hull_planes(mesh);
    const SurfaceQuery surface(mesh);
    int tested = 0;
    const Vertices locals = test::cloud(test::Cloud::box, 2000, random);
    for (const auto& local : locals.rowwise()) {
      const Point p = local + Point(offset, -offset, 2 * offset);
      const double height = (planes.leftCols<3>() * p.transpose() - planes.col(3)).maxCoeff();
      if (std::abs(height) < 1e-5) continue;
      ++tested;
      ASSERT_EQ(surface.winding_number(p), height < 0 ? 1 : 0) << p;
    }
    EXPECT_GT(tested, 1900);
  }
}

TEST(SurfaceQuery, NestedShellsAddUp) {
  const Mesh outer = test::box(Point(-2, -2, -2), Point(2, 2, 2)), inner = test::box(Point(-1, -1, -1), Point(1, 1, 1));
  const SurfaceQuery twice(joined(outer, inner)), hollow(joined(outer, inside_out(inner))), turned(inside_out(outer));
  std::mt19937_64 random(4);
  const Vertices points = 2.5 * test::cloud(test::Cloud::box, 1000, random);
  for (const auto& p : points.rowwise()) {
    const double far = p.cwiseAbs().maxCoeff();
    if (std::abs(far - 1) < 1e-4 || std::abs(far - 2) < 1e-4) continue;
    ASSERT_EQ(twice.winding_number(p), far < 1 ? 2 : far < 2 ? 1 : 0) << p;
    ASSERT_EQ(hollow.winding_number(p), far < 1 ? 0 : far < 2 ? 1 : 0) << p;
    ASSERT_EQ(turned.winding_number(p), far < 2 ? -1 : 0) << p;
  }
}

TEST(SurfaceQuery, PointsOnTheGridOfABoxAreNotLost) {
  // Rays from such points run along faces and diagonals as often as a fixed direction can.
  Mesh mesh = test::box(Point(0, 0, 0), Point(1, 1, 1));
  const SurfaceQuery surface(mesh);
  for (int i = 1; i < 16; ++i)
    for (int j = 1; j < 16; ++j)
      for (int k = 1; k < 16; ++k) {
        ASSERT_TRUE(surface.contains(Point(i, j, k) / 16));
        ASSERT_FALSE(surface.contains(Point(i, j, k) / 16 + Point(1, 0, 0)));
      }
}

TEST(SurfaceQuery, AnOpenSurfaceWindsRoundByTheShareOfDirections) {
  Mesh open = test::box(Point(-1, -1, -1), Point(1, 1, 1));
  std::vector<int> keep;  // all but the top
  for (int f = 0; f < open.faces.rows(); ++f)
    if ((open.vertices(open.faces.row(f), 1).array() < 1).any()) keep.push_back(f);
  ASSERT_EQ(keep.size(), 10u);
  open.faces = Faces(open.faces(keep, Eigen::all));
  const SurfaceQuery surface(open);
  EXPECT_NEAR(surface.winding_number(Point(0, 0, 0)), 5.0 / 6,
              0.1);  // Each side of a cube takes a sixth of the sphere.
  EXPECT_GT(surface.winding_number(Point(0, -0.9, 0)), 0.9);
  EXPECT_NEAR(surface.winding_number(Point(0, 3, 0)), std::asin(0.2) / std::numbers::pi, 0.05);  // through the top
}

TEST(SurfaceQuery, FirstHitIsTheNearestFaceThatTheRayMeets) {
  std::mt19937_64 random(5);
  const Mesh mesh = soup(50, random);
  const SurfaceQuery surface(mesh);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point p = test::random_direction(random) * 1.5, direction = test::random_direction(random);
    double nearest = 1e300, margin = 1e300;  // by which the nearest face is met, in barycentric coordinates
    int face = -1;
    for (int f = 0; f < mesh.faces.rows(); ++f) {
      Eigen::Matrix3d system;
      const Point a = mesh.vertices.row(mesh.faces(f, 0));
      system << (mesh.vertices.row(mesh.faces(f, 1)) - a).transpose(),
          (mesh.vertices.row(mesh.faces(f, 2)) - a).transpose(), -direction.transpose();
      const Eigen::Vector3d s = system.colPivHouseholderQr().solve((p - a).transpose());
      const double inside = std::min({s[0], s[1], 1 - s[0] - s[1]});
      if (s[2] > 0.1) margin = std::min(margin, std::abs(inside));
      if (inside > 0 && s[2] > 0.1 && s[2] < nearest) nearest = s[2], face = f;
    }
    if (margin < 1e-4) continue;  // Along an edge either answer will do.
    const SurfaceQuery::Hit hit = surface.first_hit(p, 3 * direction, 0.1);
    ASSERT_EQ(hit.face, face);
    if (face < 0) continue;
    ++hits;
    ASSERT_NEAR(hit.distance, nearest, 1e-4);
  }
  EXPECT_GT(hits, 100);
}

TEST(SurfaceQuery, FacesWithoutAreaAreSegmentsToDistancesAndNothingToRays) {
  Mesh mesh{Vertices(5, 3), Faces(3, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 9, 9, 9;
  mesh.faces << 0, 1, 3, 4, 4, 4, 0, 1, 2;
  const SurfaceQuery surface(mesh);
  EXPECT_EQ(surface.first_hit(Point(0.2, 0.2, 1), Point(0, 0, -1), 0).face, 2);
  EXPECT_EQ(surface.first_hit(Point(1.5, 0, 1), Point(0, 0, -1), 0).face, -1);
  EXPECT_NEAR(surface.distance(Point(0.2, 0.2, 1)), 1, 1e-5);
  EXPECT_NEAR(surface.distance(Point(1.7, -1, 0)), 1, 1e-5);
  EXPECT_NEAR(surface.distance(Point(9, 9, 8)), 1, 1e-5);
  mesh.faces.conservativeResize(2, 3);
  EXPECT_THROW(SurfaceQuery{mesh}, InputError);
  EXPECT_THROW(SurfaceQuery{Mesh{}}, InputError);
}

}  // namespace
}  // namespace partwise
