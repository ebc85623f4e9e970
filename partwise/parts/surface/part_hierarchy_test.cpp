#include "partwise/parts/surface/part_hierarchy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// A strip of `squares` unit squares along x, two faces each.
Mesh strip(int squares) {
  Mesh mesh{Vertices(2 * squares + 2, 3), Faces(2 * squares, 3)};
  for (int i = 0; i <= squares; ++i) {
    mesh.vertices.row(2 * i) << i, 0, 0;
    mesh.vertices.row(2 * i + 1) << i, 1, 0;
  }
  for (int i = 0; i < squares; ++i) {
    mesh.faces.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
    mesh.faces.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
  }
  return mesh;
}

// Of each face, what its square has.
template <typename Value>
std::vector<Value> twice(const std::vector<Value>& squares) {
  std::vector<Value> faces;
  for (const Value& value : squares) faces.insert(faces.end(), 2, value);
  return faces;
}

Eigen::VectorXd values_of(const std::vector<double>& squares) {
  const std::vector<double> faces = twice(squares);
  return Eigen::Map<const Eigen::VectorXd>(faces.data(), static_cast<Eigen::Index>(faces.size()));
}

TEST(PartHierarchy, GroupsWhatIsWithinAStep) {
  // Shares of the area 1/2, 1/4 (one octave apart), 1/32 (three from the second), 1/64.
  const Mesh mesh = strip(4);
  const PartHierarchy tree =
      part_hierarchy(mesh, twice<int>({0, 1, 2, 3}), values_of({2, 1, 0.125, 0.0625}), {.steps = {1}});
  EXPECT_EQ(tree.parts, 4);
  EXPECT_EQ(tree.parents, (std::vector<int>{4, 4, 5, 5, 6, 6, -1}));
  EXPECT_EQ(tree.root_path(2), (std::vector<int>{2, 5, 6}));
  const PartHierarchy wide =
      part_hierarchy(mesh, twice<int>({0, 1, 2, 3}), values_of({2, 1, 0.125, 0.0625}), {.steps = {1, 3}});
  EXPECT_EQ(wide.parents, tree.parents);  // the second step gathers all and so is the root
}

TEST(PartHierarchy, OnlyNeighboursFormGroups) {
  const PartHierarchy tree = part_hierarchy(strip(3), twice<int>({0, 1, 2}), values_of({1, 0.01, 1}), {.steps = {1}});
  EXPECT_EQ(tree.parents, (std::vector<int>{3, 3, 3, -1}));
}

TEST(PartHierarchy, APartThatIsAllIsTheRoot) {
  const PartHierarchy tree = part_hierarchy(strip(2), twice<int>({0, 0}), values_of({1, 2}));
  EXPECT_EQ(tree.parents, std::vector<int>{-1});
  EXPECT_EQ(tree.root_path(0), std::vector<int>{0});
  EXPECT_NEAR(tree.histograms.sum(), 1, 1e-12);
}

TEST(PartHierarchy, PiecesThatDoNotTouchMeetInTheRoot) {
  Mesh mesh = strip(3);
  mesh.faces.row(2).setZero();  // the square in the middle is gone
  mesh.faces.row(3).setZero();
  const PartHierarchy tree = part_hierarchy(mesh, twice<int>({0, 1, 2}), values_of({1, 1, 1}));
  EXPECT_EQ(tree.parents, (std::vector<int>{3, 3, 3, -1}));
  EXPECT_EQ(tree.histograms.row(1).sum(), 0);
}

TEST(PartHierarchy, HistogramsAreSharesOfAreaByLevel) {
  // One of four squares sees a quarter of the area, the others all of it: levels 8 and 10 octaves of 10.
  const PartHierarchy tree =
      part_hierarchy(strip(4), twice<int>({0, 1, 1, 1}), values_of({1, 4, 4, 4}), {.bins = 11, .octaves = 10});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 11);
  expected(0, 8) = expected(2, 8) = 0.25;
  expected(1, 10) = expected(2, 10) = 0.75;
  EXPECT_TRUE(tree.histograms.isApprox(expected, 1e-12)) << tree.histograms;
  // A level between two bins counts for both: log2(3/4) is 0.415 below the last.
  const PartHierarchy between =
      part_hierarchy(strip(4), twice<int>({0, 0, 0, 0}), values_of({3, 3, 3, 3}), {.bins = 11, .octaves = 10});
  EXPECT_NEAR(between.histograms(0, 9), -std::log2(0.75), 1e-12);
  EXPECT_NEAR(between.histograms(0, 10), 1 + std::log2(0.75), 1e-12);
}

TEST(PartHierarchy, ScaleAndPlaceDoNotMatter) {
  const Mesh mesh = strip(5);
  const std::vector<int> labels = twice<int>({0, 0, 1, 2, 2});
  const Eigen::VectorXd values = values_of({3, 3.5, 0.2, 1, 2});
  const PartHierarchy tree = part_hierarchy(mesh, labels, values);
  Mesh moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.vertices = ((7 * mesh.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(4, 5, 6)).eval();
  const PartHierarchy other = part_hierarchy(moved, labels, 49 * values);
  EXPECT_EQ(other.parents, tree.parents);
  EXPECT_TRUE(other.histograms.isApprox(tree.histograms, 1e-9));
}

TEST(PartHierarchy, ChildrenAddUpToTheirParents) {
  std::vector<int> squares(40);
  std::iota(squares.begin(), squares.end(), 0);
  std::vector<double> values;
  for (const int i : squares) values.push_back(20 * (1.1 + std::sin(1.7 * i)));
  const PartHierarchy tree = part_hierarchy(strip(40), twice(squares), values_of(values), {.steps = {0.25, 0.5, 1}});
  ASSERT_GT(tree.nodes(), 45);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(tree.nodes(), tree.histograms.cols());
  std::vector<int> children(static_cast<std::size_t>(tree.nodes()), 0);
  for (int node = 0; node + 1 < tree.nodes(); ++node) {
    ASSERT_GT(tree.parents[node], node);
    sums.row(tree.parents[node]) += tree.histograms.row(node);
    ++children[tree.parents[node]];
  }
  for (int node = tree.parts; node < tree.nodes(); ++node) {
    EXPECT_GE(children[node], 2);
    EXPECT_TRUE(sums.row(node).isApprox(tree.histograms.row(node), 1e-9));
  }
  EXPECT_NEAR(tree.histograms.bottomRows(1).sum(), 1, 1e-12);
}

TEST(PartHierarchy, RefusesWhatDoesNotFit) {
  const Mesh mesh = strip(2);
  EXPECT_THROW(part_hierarchy(mesh, std::vector<int>{0}, values_of({1, 1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, 0}), values_of({1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, -1}), values_of({1, 1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, 2}), values_of({1, 1})), InputError);
  Mesh flat = mesh;
  flat.vertices.setZero();
  EXPECT_THROW(part_hierarchy(flat, twice<int>({0, 0}), values_of({1, 1})), InputError);
}

}  // namespace
}  // namespace partwise
