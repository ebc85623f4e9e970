#include "partwise/geometry/principal_axes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

// Corners at random: no two moments agree, and no third one is zero.
Mesh lopsided() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Mesh mesh{Vertices(30, 3), Faces(40, 3)};
  for (double& x : mesh.vertices.reshaped()) x = uniform(random);
  mesh.vertices.col(0) *= 3;
  mesh.vertices.col(1) *= 2;
  for (int& v : mesh.faces.reshaped()) v = static_cast<int>(random() % 30);
  return mesh;
}

TEST(PrincipalAxes, TurnWithTheShape) {
  const Mesh mesh = lopsided();
  const Eigen::Matrix3d axes = principal_axes(mesh);
  EXPECT_NEAR((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_NEAR(axes.determinant(), 1, 1e-12);
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
    const Point shift(normal(random), normal(random), normal(random));
    const Mesh turned{(mesh.vertices * turn.transpose() * 7.0).rowwise() + shift, mesh.faces};
    EXPECT_NEAR((principal_axes(turned) * turn - axes).norm(), 0, 1e-9);
  }
}

// Second moments by a sum over many small triangles of each face.
TEST(PrincipalAxes, DiagonaliseTheSecondMomentsOfArea) {
  const Mesh mesh = lopsided();
  const Eigen::Matrix3d axes = principal_axes(mesh);
  constexpr int kSteps = 60;
  double area = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), cubes = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  std::vector<std::pair<double, Eigen::Vector3d>> samples;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Point a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1));
    const Point c = mesh.vertices.row(mesh.faces(f, 2));
    const double weight = (b - a).cross(c - a).norm();
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; i + j < kSteps; ++j) {
        const double u = (i + 1.0 / 3) / kSteps, v = (j + 1.0 / 3) / kSteps;
        samples.emplace_back(weight, (a + u * (b - a) + v * (c - a)).transpose());
        area += weight;
        sum += weight * samples.back().second;
      }
  }
  for (const auto& [weight, x] : samples) {
    const Eigen::Vector3d y = axes * (x - sum / area);
    products += weight / area * y * y.transpose();
    cubes += weight / area * y.array().cube().matrix();
  }
  const double scale = products.trace();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(products(i, j) / scale, 0, 0.02);
  EXPECT_GT(products(0, 0), products(1, 1));
  EXPECT_GT(products(1, 1), products(2, 2));
  EXPECT_GT(cubes[0], 0);
  EXPECT_GT(cubes[1], 0);
}

TEST(PrincipalAxes, OfUprightBoxesAreThoseOfTheCoordinatesExactly) {
  for (const Point& size : {Point(3, 2, 1), Point(1, 2, 3), Point(1, 1, 1), Point(0.1, 0.7, 0.7)}) {
    const Eigen::Matrix3d axes = principal_axes(test::box(Point(0.3, -0.2, 0.1), Point(0.3, -0.2, 0.1) + size));
    EXPECT_EQ(axes, Eigen::Matrix3d(axes.array().round())) << size;
    EXPECT_EQ(axes.cwiseAbs().sum(), 3);
    EXPECT_EQ(axes.determinant(), 1);
  }
}

TEST(PrincipalAxes, OfNothingAreTheIdentity) {
  EXPECT_EQ(principal_axes({Vertices::Zero(3, 3), Faces::Zero(1, 3)}), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(principal_axes({}), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

}  // namespace
}  // namespace partwise
