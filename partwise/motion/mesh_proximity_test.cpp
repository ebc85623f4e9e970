#include "partwise/motion/mesh_proximity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "partwise/base/draw.h"
#include "partwise/geometry/closest_point.h"
#include "partwise/motion/configuration_space.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

using Corners = std::array<Point, 3>;

Corners corners(const Mesh& mesh, Eigen::Index face) {
  return {mesh.vertices.row(mesh.faces(face, 0)), mesh.vertices.row(mesh.faces(face, 1)),
          mesh.vertices.row(mesh.faces(face, 2))};
}

double segment_distance(const Point& a, const Point& b, const Point& c, const Point& d) {
  double least = std::min({offset_from_segment(a, c, d).norm(), offset_from_segment(b, c, d).norm(),
                           offset_from_segment(c, a, b).norm(), offset_from_segment(d, a, b).norm()});
  // Of the lines, where the feet lie within both.
  const Point u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  if (det <= 1e-14 * uu * vv) return least;
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / det, t = (uu * v.dot(w) - uv * u.dot(w)) / det;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, (w + s * u - t * v).norm());
  return least;
}

bool pierces(const Point& a, const Point& b, const Corners& triangle) {
  const Point u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], along = b - a;
  Eigen::Matrix3d matrix;
  matrix << u.transpose(), v.transpose(), -along.transpose();
  if (std::abs(matrix.determinant()) < 1e-30) return false;
  const Eigen::Vector3d at = matrix.inverse() * (a - triangle[0]).transpose();
  return at[0] >= 0 && at[1] >= 0 && at[0] + at[1] <= 1 && at[2] >= 0 && at[2] <= 1;
}

double triangle_distance(const Corners& p, const Corners& q) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (pierces(p[i], p[(i + 1) % 3], q) || pierces(q[i], q[(i + 1) % 3], p)) return 0;
    least = std::min({least, offset_from_triangle(p[i], q[0], q[1], q[2]).norm(),
                      offset_from_triangle(q[i], p[0], p[1], p[2]).norm()});
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, segment_distance(p[i], p[(i + 1) % 3], q[k], q[(k + 1) % 3]));
  }
  return least;
}

double brute_force(const Mesh& a, const Mesh& b) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < a.faces.rows(); ++i) {
    for (Eigen::Index k = 0; k < b.faces.rows(); ++k)
      least = std::min(least, triangle_distance(corners(a, i), corners(b, k)));
  }
  return least;
}

// Of faces that are often thin, and share no vertex.
Mesh soup(int faces, double size, Draw& draw) {
  Mesh mesh;
  mesh.vertices.resize(3 * faces, 3);
  mesh.faces.resize(faces, 3);
  for (int f = 0; f < faces; ++f) {
    const Point centre(draw.within(-1, 1), draw.within(-1, 1), draw.within(-1, 1));
    const double thin = std::pow(10, -4 * draw.unit());
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.row(3 * f + k) = centre;
      for (int i = 0; i < 3; ++i) mesh.vertices(3 * f + k, i) += 0.3 * draw.within(-1, 1) * (i == 0 ? thin : 1);
      mesh.faces(f, k) = 3 * f + k;
    }
  }
  mesh.vertices *= size;
  return mesh;
}

Mesh placed(Mesh mesh, const Eigen::Isometry3d& pose) {
  mesh.vertices = (mesh.vertices * pose.linear().transpose()).eval();
  mesh.vertices.rowwise() += pose.translation().transpose();
  return mesh;
}

void expect_brute_force(double size, double apart) {
  Draw draw(11, 0, 0);
  const Eigen::AlignedBox3d bounds(Eigen::Vector3d::Constant(-apart * size), Eigen::Vector3d::Constant(apart * size));
  const ConfigurationSpace space(SpaceKind::se3, bounds, 1);
  int touching = 0;
  for (int round = 0; round < 12; ++round) {
    const Mesh a = soup(30, size, draw), b = soup(25, size, draw);
    const double scale = proximity_scale(size);
    const ProximityMesh fixed(a, scale), other(b, scale);
    for (int i = 0; i < 15; ++i) {
      const Eigen::Isometry3d pose = space.pose(space.drawn(draw));
      const double expected = brute_force(a, placed(b, pose));
      const auto found = fixed.nearest(other, pose, std::numeric_limits<double>::infinity());
      ASSERT_TRUE(found.has_value());
      ASSERT_NEAR(found->distance, expected, 1e-9 * size);
      EXPECT_EQ(fixed.touches(other, pose), expected == 0);
      touching += expected == 0;
      if (expected < 1e-6 * size) continue;
      // The witnesses lie on the two meshes, in the world.
      const Mesh moved = placed(b, pose);
      double here = 1e300, there = 1e300;
      for (Eigen::Index f = 0; f < a.faces.rows(); ++f) {
        const auto [p, q, r] = corners(a, f);
        here = std::min(here, offset_from_triangle(found->here.transpose(), p, q, r).norm());
      }
      for (Eigen::Index f = 0; f < moved.faces.rows(); ++f) {
        const auto [p, q, r] = corners(moved, f);
        there = std::min(there, offset_from_triangle(found->there.transpose(), p, q, r).norm());
      }
      EXPECT_LT(here, 1e-9 * size);
      EXPECT_LT(there, 1e-9 * size);
      EXPECT_FALSE(fixed.nearest(other, pose, 0.999 * expected).has_value());
      EXPECT_TRUE(fixed.nearest(other, pose, 1.001 * expected).has_value());
    }
  }
  EXPECT_GT(touching, apart < 2 ? 40 : 0);
  EXPECT_LT(touching, 12 * 15);
}

TEST(MeshProximity, IsThatOfAllTriangles) {
  expect_brute_force(1, 1.5);
  expect_brute_force(1, 3);
}

// FCL takes triangles below 3e-8 for degenerate, in any unit.
TEST(MeshProximity, DoesNotDependOnTheUnit) {
  expect_brute_force(1e-5, 2.5);
  expect_brute_force(1e6, 2.5);
}

TEST(MeshProximity, KnowsBoxesByClosedForm) {
  const Mesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  const ProximityMesh fixed(box, proximity_scale(10)), other(box, proximity_scale(10));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto at = [&](double x, double y, double z) {
    pose.translation() << x, y, z;
    return fixed.nearest(other, pose, 100)->distance;
  };
  EXPECT_NEAR(at(3, 0.5, 0.2), 1, 1e-12);
  EXPECT_NEAR(at(3, 4, 0), std::hypot(1, 2), 1e-12);
  EXPECT_NEAR(at(-3, 4, 5), std::sqrt(1 + 4 + 9), 1e-12);
  EXPECT_EQ(at(1.5, 0, 0), 0);
  EXPECT_TRUE(fixed.touches(other, pose));
}

}  // namespace
}  // namespace partwise
