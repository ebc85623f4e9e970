#include "partwise/geometry/mass.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Edges of lengths a, b, c along the axes, centred at the origin.
Mesh box(double a, double b, double c) {
  Mesh mesh{Vertices(8, 3), Faces(12, 3)};
  for (int i = 0; i < 8; ++i) mesh.vertices.row(i) << (i & 4 ? a : -a) / 2, (i & 2 ? b : -b) / 2, (i & 1 ? c : -c) / 2;
  mesh.faces << 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7,
      3;
  return mesh;
}

Eigen::Matrix3d box_inertia(double a, double b, double c) {
  return Eigen::Vector3d(b * b + c * c, a * a + c * c, a * a + b * b).asDiagonal() * (a * b * c / 12);
}

Mesh tetrahedron() {
  Mesh mesh{Vertices(4, 3), Faces(4, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

TEST(Mass, Box) {
  const MassProperties p = mass_properties(box(1, 2, 3));
  EXPECT_DOUBLE_EQ(p.volume, 6);
  EXPECT_LT(p.centre.norm(), 1e-15);
  EXPECT_LT((p.inertia - box_inertia(1, 2, 3)).norm(), 1e-13);
  EXPECT_TRUE(is_physical(p));
}

TEST(Mass, TheCornerTetrahedron) {
  // Integrals over the unit simplex: 1/6, x: 1/24, x^2: 1/60, x y: 1/120; about the centre x^2: 1/60 - 1/96 and x y:
  // 1/120 - 1/96.
  const MassProperties p = mass_properties(tetrahedron());
  EXPECT_NEAR(p.volume, 1.0 / 6, 1e-16);
  EXPECT_LT((p.centre - Point::Constant(0.25)).norm(), 1e-15);
  const double square = 1.0 / 60 - 1.0 / 96, product = 1.0 / 120 - 1.0 / 96;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Constant(-product);
  inertia.diagonal().setConstant(2 * square);
  EXPECT_LT((p.inertia - inertia).norm(), 1e-16);
}

TEST(Mass, MovedAndTurned) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Point shift(100, -2000, 30000);
  Mesh mesh = box(1, 2, 3);
  mesh.vertices = (mesh.vertices * rotation.transpose()).rowwise() + shift;
  const MassProperties p = mass_properties(mesh);
  EXPECT_NEAR(p.volume, 6, 1e-9);
  EXPECT_LT((p.centre - shift).norm(), 1e-9);
  EXPECT_LT((p.inertia - rotation * box_inertia(1, 2, 3) * rotation.transpose()).norm(), 1e-8);
}

TEST(Mass, InsideOutIsTheSame) {
  Mesh mesh = box(1, 2, 3);
  mesh.faces.col(1).swap(mesh.faces.col(2));
  const MassProperties p = mass_properties(mesh);
  EXPECT_DOUBLE_EQ(p.volume, 6);
  EXPECT_LT((p.inertia - box_inertia(1, 2, 3)).norm(), 1e-13);
}

TEST(Mass, UnusedVerticesDoNotCount) {
  Mesh mesh = box(1, 2, 3);
  mesh.vertices.conservativeResize(9, 3);
  mesh.vertices.row(8) << 1e9, 1e9, -1e9;
  EXPECT_DOUBLE_EQ(mass_properties(mesh).volume, 6);
}

TEST(Mass, BodiesTogether) {
  // A box of 4 x 2 x 3 from two of 1 and 3 along x, with a flat one in between that counts for nothing.
  std::vector<Mesh> boxes{box(1, 2, 3), box(3, 2, 3), box(4, 2, 0)};
  boxes[0].vertices.col(0).array() += 7 - 1.5;
  boxes[1].vertices.col(0).array() += 7 + 0.5;
  const MassProperties p = mass_properties(std::span<const Mesh>(boxes));
  EXPECT_DOUBLE_EQ(p.volume, 24);
  EXPECT_LT((p.centre - Point(7, 0, 0)).norm(), 1e-14);
  EXPECT_LT((p.inertia - box_inertia(4, 2, 3)).norm(), 1e-12);
}

TEST(Mass, WithoutVolume) {
  EXPECT_THROW(mass_properties(box(1, 2, 0)), InputError);
  EXPECT_THROW(mass_properties(Mesh{Vertices(0, 3), Faces(0, 3)}), InputError);
  EXPECT_THROW(mass_properties(std::span<const Mesh>()), InputError);
}

TEST(Mass, PhysicalOnes) {
  MassProperties p = mass_properties(box(1, 2, 3));
  p.inertia = Eigen::Vector3d(1, 1, 2.1).asDiagonal();
  EXPECT_FALSE(is_physical(p));
  p.inertia = Eigen::Vector3d(1, 1, 2).asDiagonal();
  EXPECT_TRUE(is_physical(p));
  p.inertia = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  EXPECT_FALSE(is_physical(p));
}

}  // namespace
}  // namespace partwise
