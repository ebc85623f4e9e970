// Shapes and checks that several tests of this room share.
#pragma once

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/mesh.h"

namespace partwise::test {

inline Point random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Point(normal(random), normal(random), normal(random)).normalized();
}

inline Eigen::Matrix3d random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

enum class Cloud { ball, box, sphere, elongated, slab };

inline Vertices cloud(Cloud kind, int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> side(-1, 1), unit(0, 1);
  Vertices points(count, 3);
  for (auto row : points.rowwise()) {
    const Point direction = random_direction(random);
    const Point in_box(side(random), side(random), side(random));
    switch (kind) {
      case Cloud::ball:
        row = direction * std::cbrt(unit(random));
        break;
      case Cloud::box:
        row = in_box;
        break;
      case Cloud::sphere:
        row = direction;
        break;
      case Cloud::elongated:
        row = direction.cwiseProduct(Point(10, 3, 1));
        break;
      case Cloud::slab:
        row = in_box.cwiseProduct(Point(1, 1, 1e-4));
        break;
    }
  }
  return points;
}

inline Vertices box_corners(const Point& low, const Point& high) {
  Vertices corners(8, 3);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) corners(i, k) = i >> k & 1 ? high[k] : low[k];
  return corners;
}

inline Mesh box(const Point& low, const Point& high) { return convex_hull(box_corners(low, high), 1e-9).mesh; }

// The largest distance by which a point lies outside of a plane through the first corner of a face. Faces thinner than
// rounding have no plane of their own: theirs is held to the bound divided by their height over their longest edge.
inline double largest_excess(const Mesh& hull, const Vertices& points) {
  double excess = -1e300;
  const Point middle = points.colwise().mean();
  const Vertices local = points.rowwise() - middle;
  for (const auto& f : hull.faces.rowwise()) {
    const Point a = hull.vertices.row(f[0]), b = hull.vertices.row(f[1]), c = hull.vertices.row(f[2]);
    const Point normal = (b - a).cross(c - a);
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const double height = normal.norm() / longest;
    if (height == 0) continue;
    const double outside = (local * normal.normalized().transpose()).maxCoeff() - (a - middle).dot(normal.normalized());
    excess = std::max(excess, outside * std::min(1.0, height / longest));
  }
  return excess;
}

// Every edge is passed once in each direction, no face repeats a corner, every vertex is used, V - E + F = 2.
inline void expect_closed_sphere(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> passed;
  std::vector<int> used(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  for (const auto& f : mesh.faces.rowwise())
    for (int k = 0; k < 3; ++k) {
      ++passed[{f[k], f[(k + 1) % 3]}];
      EXPECT_NE(f[k], f[(k + 1) % 3]);
      used[f[k]] = 1;
    }
  for (const auto& [edge, count] : passed) {
    EXPECT_EQ(count, 1) << edge.first << " to " << edge.second;
    EXPECT_TRUE(passed.contains({edge.second, edge.first})) << edge.first << " to " << edge.second;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  EXPECT_EQ(mesh.vertices.rows() - mesh.faces.rows() / 2, 2);
}

}  // namespace partwise::test
