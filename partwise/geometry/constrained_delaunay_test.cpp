#include "partwise/geometry/constrained_delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace partwise {
namespace {

std::vector<Point2> random_points(std::mt19937_64& random, int count, int grid) {
  std::uniform_int_distribution<int> on_grid(0, grid);
  std::set<std::pair<int, int>> seen;
  std::vector<Point2> points;
  while (static_cast<int>(points.size()) < count) {
    const int x = on_grid(random), y = on_grid(random);
    if (seen.insert({x, y}).second) points.emplace_back(x, y);
  }
  return points;
}

bool properly_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

std::vector<std::pair<int, int>> pieces(const ConstrainedDelaunay& mesh) {
  std::vector<std::pair<int, int>> fixed;
  for (const auto& t : mesh.triangles()) {
    for (int i = 0; i < 3; ++i) {
      if (t.fixed[i]) fixed.emplace_back(t.v[(i + 1) % 3], t.v[(i + 2) % 3]);
    }
  }
  return fixed;
}

// The segment a b, split at the points on it.
std::vector<std::pair<int, int>> split(std::span<const Point2> points, int a, int b) {
  const Point2 ab = points[b] - points[a];
  std::vector<std::pair<double, int>> stops;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double along = (points[v] - points[a]).dot(ab);
    if (orientation(points[a], points[b], points[v]) == 0 && along >= 0 && along <= ab.squaredNorm())
      stops.emplace_back(along, static_cast<int>(v));
  }
  std::sort(stops.begin(), stops.end());
  std::vector<std::pair<int, int>> parts;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) parts.emplace_back(stops[k].second, stops[k + 1].second);
  return parts;
}

// Every triangle runs counter-clockwise, neighbours name each other and agree on fixed edges, and the areas add up.
void expect_triangulation(const ConstrainedDelaunay& mesh, std::span<const Point2> points) {
  const auto triangles = mesh.triangles();
  EXPECT_EQ(triangles.size(), 2 * points.size() + 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& triangle = triangles[t];
    for (int i = 0; i < 3; ++i) {
      const int u = triangle.neighbour[i];
      if (u < 0) continue;
      const auto& back = triangles[u].neighbour;
      const auto k = std::find(back.begin(), back.end(), static_cast<int>(t)) - back.begin();
      ASSERT_LT(k, 3);
      EXPECT_EQ(triangles[u].fixed[k], triangle.fixed[i]);
      EXPECT_EQ(triangles[u].v[(k + 1) % 3], triangle.v[(i + 2) % 3]);
      EXPECT_EQ(triangles[u].v[(k + 2) % 3], triangle.v[(i + 1) % 3]);
    }
    if (*std::max_element(triangle.v.begin(), triangle.v.end()) < mesh.point_count()) {
      EXPECT_EQ(orientation(points[triangle.v[0]], points[triangle.v[1]], points[triangle.v[2]]), 1);
    }
  }
}

TEST(Orientation, IsExactWhereRoundingWouldDecide) {
  // Points on a line of slope 1, moved by units in the last place.
  const double ulp = std::ldexp(1.0, -53);
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      const Point2 a(0.5 + i * ulp, 0.5 + j * ulp), b(12, 12), c(24, 24);
      EXPECT_EQ(orientation(a, b, c), i < j ? 1 : i > j ? -1 : 0) << i << " " << j;
      EXPECT_EQ(orientation(b, a, c), -orientation(a, b, c));
      EXPECT_EQ(orientation(b, c, a), orientation(a, b, c));
    }
  }
}

TEST(ConstrainedDelaunay, NoPointInAnyCircleOfFreeTriangles) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 60; ++round) {
    const auto points = random_points(random, 3 + round, round % 2 ? 12 : 1000);
    const ConstrainedDelaunay mesh(points);
    expect_triangulation(mesh, points);
    for (const auto& t : mesh.triangles()) {
      if (*std::max_element(t.v.begin(), t.v.end()) >= mesh.point_count()) continue;
      for (const Point2& p : points) EXPECT_FALSE(inside_circle(points[t.v[0]], points[t.v[1]], points[t.v[2]], p));
    }
  }
}

TEST(ConstrainedDelaunay, FixesEdgesThatDoNotCrossAndRefusesThoseThatDo) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 60; ++round) {
    const auto points = random_points(random, 30, round % 2 ? 9 : 500);
    ConstrainedDelaunay mesh(points);
    std::vector<std::pair<int, int>> fixed;
    std::uniform_int_distribution<int> any(0, 29);
    for (int tries = 0; tries < 60; ++tries) {
      const int a = any(random), b = any(random);
      if (a == b) continue;
      bool clear = true;  // Crossing at a vertex is allowed: there the pieces only meet.
      for (const auto& [p, q] : pieces(mesh)) {
        for (const auto& [from, to] : split(points, a, b)) {
          if (properly_cross(points[from], points[to], points[p], points[q])) clear = false;
        }
      }
      const auto walk = mesh.walk(a, b);
      if (!walk.through_vertex) {
        EXPECT_EQ(walk.crossed.empty(), clear);
      }
      EXPECT_EQ(mesh.insert_edge(a, b), clear);
      if (clear) fixed.emplace_back(a, b);
      expect_triangulation(mesh, points);
    }
    // What was fixed is covered by fixed edges of the mesh, piece by piece.
    for (const auto& [a, b] : fixed) {
      const auto now = pieces(mesh);
      for (const auto& piece : split(points, a, b)) EXPECT_TRUE(std::count(now.begin(), now.end(), piece) == 1);
    }
  }
}

TEST(ConstrainedDelaunay, InsideIsWhatTheRingEncloses) {
  // A square with a square hole, one corner of which touches the outline.
  const std::vector<Point2> points{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 0}, {6, 2}, {4, 4}, {2, 2}};
  ConstrainedDelaunay mesh(points);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(mesh.insert_edge(i, (i + 1) % 4));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(mesh.insert_edge(4 + i, 4 + (i + 1) % 4));
  mesh.mark_inside();
  double area = 0;
  for (const auto& t : mesh.triangles()) {
    if (t.inside) area += cross(points[t.v[1]] - points[t.v[0]], points[t.v[2]] - points[t.v[0]]) / 2;
  }
  EXPECT_DOUBLE_EQ(area, 64 - 8);
  EXPECT_TRUE(mesh.walk(6, 2).inside);
  EXPECT_FALSE(mesh.walk(6, 4).inside);
  EXPECT_EQ(mesh.walk(3, 4).crossed.size(), 1u);  // in through the side 6 7, then at the corner 4
}

}  // namespace
}  // namespace partwise
