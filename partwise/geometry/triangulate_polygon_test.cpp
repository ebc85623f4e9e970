#include "partwise/geometry/triangulate_polygon.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

namespace partwise {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

Triangles triangulate(const Vertices& vertices) {
  std::vector<int> polygon(static_cast<std::size_t>(vertices.rows()));
  std::iota(polygon.begin(), polygon.end(), 0);
  Triangles triangles;
  triangulate_polygon(vertices, polygon, triangles);
  return triangles;
}

Point vector_area(const Vertices& v, const std::array<int, 3>& t) {
  return Point(v.row(t[1]) - v.row(t[0])).cross(Point(v.row(t[2]) - v.row(t[0]))) / 2;
}

// The triangles cover a simple plane polygon if all turn its way and their areas add up to its own.
void expect_covers(const Vertices& v, const Triangles& triangles) {
  Point area = Point::Zero();
  for (Eigen::Index i = 0; i < v.rows(); ++i) area += Point(v.row(i)).cross(Point(v.row((i + 1) % v.rows()))) / 2;
  ASSERT_EQ(triangles.size(), static_cast<std::size_t>(v.rows() - 2));
  double sum = 0;
  for (const auto& t : triangles) {
    EXPECT_GE(vector_area(v, t).dot(area), -1e-12);
    sum += vector_area(v, t).norm();
  }
  EXPECT_NEAR(sum, area.norm(), 1e-9 * area.norm());
}

TEST(TriangulatePolygon, ConvexOnesAreFans) {
  Vertices v(5, 3);
  for (int i = 0; i < 5; ++i) v.row(i) << std::cos(1.2 * i), 7, std::sin(1.2 * i);
  EXPECT_EQ(triangulate(v), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(TriangulatePolygon, AConcaveQuadrangleIsCutAtItsReflexCorner) {
  Vertices v(4, 3);
  v << 0, 0, 0, 2, -1, 0, 0, 2, 0, -2, -1, 0;
  const Triangles triangles = triangulate(v);
  expect_covers(v, triangles);
  for (const auto& t : triangles) EXPECT_NE(std::find(t.begin(), t.end(), 0), t.end());
}

TEST(TriangulatePolygon, RandomStarsInAnyPlane) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1), angle(-3, 3);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 4 + trial % 60;
    Vertices v(n, 3);
    for (int i = 0; i < n; ++i) {
      const double phi = 2 * std::numbers::pi * i / n, r = radius(random);
      v.row(i) << r * std::cos(phi), r * std::sin(phi), 0;
    }
    const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitX()) *
                                      Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitY()))
                                         .toRotationMatrix();
    v = (v * rotation).rowwise() + Point(3, -2, 1);
    SCOPED_TRACE(trial);
    expect_covers(v, triangulate(v));
  }
}

TEST(TriangulatePolygon, CombsAndBridgesToHoles) {
  Vertices comb(22, 3);
  for (int i = 0; i < 20; ++i) comb.row(i) << i, (i % 2 ? 1 : 9), 0;
  comb.row(20) << 19, -1, 0;
  comb.row(21) << 0, -1, 0;
  expect_covers(comb, triangulate(comb));
  const Vertices reversed = comb.colwise().reverse();
  expect_covers(reversed, triangulate(reversed));
  Vertices ring(10, 3);  // a square with a square hole, joined by a bridge that is passed twice
  ring << 0, 0, 0, 3, 0, 0, 3, 3, 0, 0, 3, 0, 0, 0, 0, 1, 1, 0, 1, 2, 0, 2, 2, 0, 2, 1, 0, 1, 1, 0;
  expect_covers(ring, triangulate(ring));
}

TEST(TriangulatePolygon, AnythingGivesTwoFewerTriangles) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> coordinate(0, 3);
  for (int trial = 0; trial < 500; ++trial) {
    Vertices v(3 + trial % 20, 3);  // crossing, flat, with repeated corners
    for (double& x : v.reshaped()) x = coordinate(random);
    EXPECT_EQ(triangulate(v).size(), static_cast<std::size_t>(v.rows() - 2));
  }
  EXPECT_EQ(triangulate(Vertices::Constant(9, 3, 1e300)).size(), 7u);
}

}  // namespace
}  // namespace partwise
