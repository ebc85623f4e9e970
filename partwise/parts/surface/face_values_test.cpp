#include "partwise/parts/surface/face_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// m triangles in a row, each sharing an edge with the next.
Mesh strip(int faces) {
  Mesh mesh{Vertices(faces + 2, 3), Faces(faces, 3)};
  for (int i = 0; i < faces + 2; ++i) mesh.vertices.row(i) << i / 2, i % 2, 0;
  for (int f = 0; f < faces; ++f) mesh.faces.row(f) << f + f % 2, f + 1 - f % 2, f + 2;
  return mesh;
}

TEST(FaceValues, MissingOnesAreFilledFromTheirNeighboursInwards) {
  Eigen::VectorXd values(7);
  values << 1, kNone, kNone, kNone, kNone, kNone, 5;
  EXPECT_EQ(fill_missing(face_adjacency(strip(7)), values), 5);
  EXPECT_EQ(values, (Eigen::VectorXd(7) << 1, 1, 1, 3, 5, 5, 5).finished());
}

TEST(FaceValues, APieceWithoutAnyValueGetsTheSmallest) {
  Mesh mesh = strip(2);  // two triangles, and two more that share nothing with them
  Vertices vertices(8, 3);
  vertices << mesh.vertices, mesh.vertices;
  Faces faces(4, 3);
  faces << mesh.faces, mesh.faces.array() + 4;
  const FaceAdjacency adjacency = face_adjacency({vertices, faces});
  Eigen::VectorXd values(4);
  values << 3, 2, kNone, kNone;
  EXPECT_EQ(fill_missing(adjacency, values), 2);
  EXPECT_EQ(values, Eigen::Vector4d(3, 2, 2, 2));
  Eigen::VectorXd none = Eigen::VectorXd::Constant(4, kNone);
  EXPECT_EQ(fill_missing(adjacency, none), 4);
  EXPECT_EQ(none, Eigen::VectorXd::Zero(4));
}

TEST(FaceValues, SmoothingIsTheWeightedMeanByHand) {
  // Five faces in a row, window 1: the middle one sees itself and one face on each side.
  Eigen::VectorXd values(5);
  values << 0, 0, 1, 3, 3;
  const Eigen::VectorXd smooth = smooth_bilaterally(face_adjacency(strip(5)), values, 1);
  const double deviation = 1.5 * std::sqrt((1.0 + 0 + 4) / 3), step = std::exp(-0.5 * 4);
  const double below = step * std::exp(-0.5 * 1 / (deviation * deviation));
  const double above = step * std::exp(-0.5 * 4 / (deviation * deviation));
  EXPECT_NEAR(smooth[2], (below * 0 + 1 + above * 3) / (below + 1 + above), 1e-14);
}

TEST(FaceValues, SmoothingKeepsConstantsAndBoundsAndSteps) {
  const Mesh mesh = test::torus(2, 1, 40, 20);
  const FaceAdjacency adjacency = face_adjacency(mesh);
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(mesh.faces.rows(), 0.7);
  EXPECT_EQ(smooth_bilaterally(adjacency, constant, 3), constant);
  // Differences whose squares vanish are none.
  const Eigen::VectorXd tiny = Eigen::VectorXd::LinSpaced(constant.size(), 1e-162, 2e-162);
  EXPECT_EQ(smooth_bilaterally(adjacency, tiny, 3), tiny);
  std::srand(1);
  const Eigen::VectorXd noisy = Eigen::VectorXd::Random(mesh.faces.rows());
  EXPECT_EQ(smooth_bilaterally(adjacency, noisy, 0), noisy);
  const Eigen::VectorXd smooth = smooth_bilaterally(adjacency, noisy, 3);
  EXPECT_LE(smooth.maxCoeff(), noisy.maxCoeff());
  EXPECT_GE(smooth.minCoeff(), noisy.minCoeff());
  EXPECT_LT((smooth.array() - smooth.mean()).square().sum(), 0.7 * (noisy.array() - noisy.mean()).square().sum());
}

TEST(FaceValues, NormalisedReachesFromZeroToOne) {
  const Eigen::Vector4d values(3, 5, 4, 7);
  EXPECT_EQ(normalised(values), Eigen::Vector4d(0, 0.5, 0.25, 1));
  EXPECT_NEAR(normalised(values, 5)[1], std::log(1 + 5 * 0.5) / std::log(6.0), 1e-15);
  EXPECT_EQ(normalised(values, 5)[3], 1);
  EXPECT_EQ(normalised(Eigen::Vector3d::Constant(2)), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace partwise
