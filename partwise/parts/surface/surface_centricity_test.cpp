#include "partwise/parts/surface/surface_centricity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

TEST(SurfaceCentricity, ALongStripByTheClosedForm) {
  // On a line of length L the mean distance at x is (x^2 + (L - x)^2) / 2 L, least in the middle, where it is L / 4.
  const int squares = 200;
  const Eigen::VectorXd found = surface_centricity(test::strip(squares), 2 * squares);  // every face is a sample
  for (int f = 0; f < 2 * squares; ++f) {
    const double x = (f / 2 + 0.5) / squares;
    EXPECT_NEAR(found[f], 2 * (x * x + (1 - x) * (1 - x)), 0.02) << f;
  }
  EXPECT_EQ(found.minCoeff(), 1);
  // Few samples, spread evenly, say much the same.
  EXPECT_LT((surface_centricity(test::strip(squares)) - found).cwiseAbs().maxCoeff(), 0.05);
}

TEST(SurfaceCentricity, NoPlaceOnASphereIsTheMiddle) {
  const Eigen::VectorXd found = surface_centricity(test::sphere(3, 24));
  EXPECT_GE(found.minCoeff(), 1);
  EXPECT_LT(found.maxCoeff(), 1.15);
}

TEST(SurfaceCentricity, BendingAStripChangesLittle) {
  Mesh bent = test::strip(60);
  const Eigen::VectorXd straight = surface_centricity(bent);
  for (auto vertex : bent.vertices.rowwise()) {  // round a cylinder on which unit steps of x keep their length
    const double angle = vertex[0] / 10, radius = 0.5 / std::sin(0.05);
    vertex = Eigen::RowVector3d(radius * std::cos(angle), vertex[1], radius * std::sin(angle)).eval();
  }
  // A little, for diagonals cut through the cylinder, so that their middles lie inside it.
  EXPECT_LT((surface_centricity(bent) - straight).cwiseAbs().maxCoeff(), 0.02);
}

TEST(SurfaceCentricity, NeitherScaleNorPlaceMatters) {
  const Mesh mesh = test::dumbbell(20, 12);
  const Eigen::VectorXd found = surface_centricity(mesh);
  Mesh moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, 2, 1).normalized()).toRotationMatrix();
  moved.vertices = ((0.01 * mesh.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3)).eval();
  EXPECT_LT((surface_centricity(moved) - found).cwiseAbs().maxCoeff(), 0.1);  // samples may differ where areas tie
  moved.vertices = 4 * mesh.vertices;                                         // exact
  EXPECT_EQ(surface_centricity(moved), found);
}

TEST(SurfaceCentricity, EachPieceHasAMiddleOfItsOwn) {
  const Mesh one = test::strip(30);
  Mesh two{Vertices(2 * one.vertices.rows(), 3), Faces(2 * one.faces.rows(), 3)};
  const Vertices large = 5 * one.vertices;
  two.vertices << one.vertices, large.rowwise() + Eigen::RowVector3d(0, 0, 9);
  two.faces << one.faces, (one.faces.array() + static_cast<int>(one.vertices.rows())).matrix();
  const Eigen::VectorXd found = surface_centricity(two, 200);
  const Eigen::VectorXd alone = surface_centricity(one, 60);
  EXPECT_LT((found.head(60) - alone).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((found.tail(60) - alone).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(surface_centricity(two, 1).head(60), Eigen::VectorXd::Ones(60));  // the smaller has no sample
}

TEST(SurfaceCentricity, RefusesWhatCannotBeMeasured) {
  Mesh flat = test::strip(2);
  EXPECT_THROW(surface_centricity(flat, 0), InputError);
  flat.vertices.setZero();
  EXPECT_THROW(surface_centricity(flat), InputError);
}

}  // namespace
}  // namespace partwise
