#include "partwise/parts/surface/part_hierarchy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "partwise/base/error.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

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

// Of each square a centricity; visibility and thickness are the same everywhere.
SurfaceMeasures by_centricity(const std::vector<double>& squares) {
  const Eigen::VectorXd centricity = values_of(squares);
  return {Eigen::VectorXd::Ones(centricity.size()), Eigen::VectorXd::Ones(centricity.size()), centricity};
}

std::vector<int> parents_of(const Mesh& mesh, const std::vector<int>& squares, const std::vector<double>& centricity) {
  return part_hierarchy(mesh, twice(squares), by_centricity(centricity)).parents;
}

// The tree by its definition: the most central part is taken away, and what hangs together without it is divided alike.
// Gives the sets of parts that are nodes.
void divide(std::vector<int> parts, const std::vector<double>& centricity, std::vector<std::vector<int>>& nodes) {
  nodes.push_back(parts);
  if (parts.size() == 1) return;
  const auto middle = std::ranges::min_element(parts, {}, [&](int k) { return centricity[k]; });
  const std::vector<int> limbs[] = {{*middle}, {parts.begin(), middle}, {middle + 1, parts.end()}};  // on a strip
  for (const std::vector<int>& limb : limbs) {
    if (!limb.empty()) divide(limb, centricity, nodes);
  }
}

TEST(PartHierarchy, LimbsAreWhatHangsTogetherWithoutTheMiddle) {
  // Hand, arm, body, leg, in a row.
  EXPECT_EQ(parents_of(test::strip(4), {0, 1, 2, 3}, {3, 2, 1, 2}), (std::vector<int>{4, 4, 5, 5, 5, -1}));
  const PartHierarchy tree = part_hierarchy(test::strip(4), twice<int>({0, 1, 2, 3}), by_centricity({3, 2, 1, 2}));
  EXPECT_EQ(tree.root_path(0), (std::vector<int>{0, 4, 5}));
  EXPECT_EQ(tree.root_path(3), (std::vector<int>{3, 5}));
}

TEST(PartHierarchy, AsByTakingTheMiddleAwayAgainAndAgain) {
  const int parts = 25;
  std::vector<int> squares(parts);
  std::iota(squares.begin(), squares.end(), 0);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> centricity;
    for (int i = 0; i < parts; ++i) centricity.push_back(2 + std::sin(1.7 * i * (trial + 1) + trial));
    std::vector<std::vector<int>> expected, found;
    divide(squares, centricity, expected);
    const PartHierarchy tree = part_hierarchy(test::strip(parts), twice(squares), by_centricity(centricity));
    found.resize(static_cast<std::size_t>(tree.nodes()));
    for (int part = 0; part < parts; ++part) {
      for (const int node : tree.root_path(part)) found[node].push_back(part);
    }
    std::ranges::sort(expected);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << trial;
  }
}

TEST(PartHierarchy, OfEquallyCentralPartsTheFirstIsTheMiddle) {
  EXPECT_EQ(parents_of(test::strip(3), {0, 1, 2}, {1, 1, 1}), (std::vector<int>{4, 3, 3, 4, -1}));
}

TEST(PartHierarchy, APartThatIsAllIsTheRoot) {
  const PartHierarchy tree = part_hierarchy(test::strip(2), twice<int>({0, 0}), by_centricity({1, 2}));
  EXPECT_EQ(tree.parents, std::vector<int>{-1});
  EXPECT_EQ(tree.root_path(0), std::vector<int>{0});
  EXPECT_NEAR(tree.histograms.sum(), 1, 1e-12);
}

TEST(PartHierarchy, PiecesThatDoNotTouchMeetInTheRoot) {
  Mesh mesh = test::strip(3);
  mesh.faces.row(2).setZero();  // the square in the middle is gone
  mesh.faces.row(3).setZero();
  const PartHierarchy tree = part_hierarchy(mesh, twice<int>({0, 1, 2}), by_centricity({1, 1, 1}));
  EXPECT_EQ(tree.parents, (std::vector<int>{3, 3, 3, -1}));
  EXPECT_EQ(tree.histograms.row(1).sum(), 0);
}

TEST(PartHierarchy, HistogramsAreSharesOfAreaByLevels) {
  // Four squares, area 4. Visibility 1/4 and all of the area: levels -2 and 0 octaves; thickness 1/8 and 1 of the root
  // of the area: -3 and 0; centricity 1 and 2: 0 and 1. Half of each share goes to either table.
  const HierarchySettings settings{.bins = 7, .visibility_range = 12, .thickness_range = 6, .centricity_range = 3};
  const std::vector<int> labels = twice<int>({0, 1, 1, 1});
  const SurfaceMeasures measures{values_of({1, 4, 4, 4}), values_of({0.25, 2, 2, 2}), values_of({2, 1, 1, 1})};
  const PartHierarchy tree = part_hierarchy(test::strip(4), labels, measures, settings);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 2 * 49);
  expected(0, 5 * 7 + 2) = expected(2, 5 * 7 + 2) = 0.125;
  expected(0, 49 + 3 * 7 + 2) = expected(2, 49 + 3 * 7 + 2) = 0.125;
  expected(1, 6 * 7) = expected(2, 6 * 7) = 0.375;
  expected(1, 49 + 6 * 7) = expected(2, 49 + 6 * 7) = 0.375;
  EXPECT_TRUE(tree.histograms.isApprox(expected, 1e-12));

  // A level between two bins counts for both: visibility 3/4 is log2(3/4) / 2 bins below the last, centricity 1 is on
  // its bin; thickness beyond the whole counts as the whole.
  const SurfaceMeasures between{values_of({3, 3, 3, 3}), values_of({9, 9, 9, 9}), values_of({1, 1, 1, 1})};
  const PartHierarchy other = part_hierarchy(test::strip(4), twice<int>({0, 0, 0, 0}), between, settings);
  const double below = -std::log2(0.75) / 2;
  EXPECT_NEAR(other.histograms(0, 5 * 7), below / 2, 1e-12);
  EXPECT_NEAR(other.histograms(0, 6 * 7), (1 - below) / 2, 1e-12);
  EXPECT_NEAR(other.histograms(0, 49 + 6 * 7), 0.5, 1e-12);
}

TEST(PartHierarchy, ScaleAndPlaceDoNotMatter) {
  const Mesh mesh = test::strip(5);
  const std::vector<int> labels = twice<int>({0, 0, 1, 2, 2});
  const SurfaceMeasures measures{values_of({3, 3.5, 0.2, 1, 2}), values_of({1, 0.5, 0.2, 1, 2}),
                                 values_of({2, 1.5, 1, 1.2, 1.9})};
  const PartHierarchy tree = part_hierarchy(mesh, labels, measures);
  Mesh moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.vertices = ((7 * mesh.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(4, 5, 6)).eval();
  const PartHierarchy other =
      part_hierarchy(moved, labels, {49 * measures.visibility, 7 * measures.thickness, measures.centricity});
  EXPECT_EQ(other.parents, tree.parents);
  EXPECT_TRUE(other.histograms.isApprox(tree.histograms, 1e-9));
}

TEST(PartHierarchy, ChildrenAddUpToTheirParents) {
  std::vector<int> squares(40);
  std::iota(squares.begin(), squares.end(), 0);
  std::vector<double> values;
  for (const int i : squares) values.push_back(1.1 + std::sin(1.7 * i));
  const Eigen::VectorXd each = values_of(values);
  const PartHierarchy tree = part_hierarchy(test::strip(40), twice(squares), {20 * each, each, 1 + each.array()});
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
  const Mesh mesh = test::strip(2);
  EXPECT_THROW(part_hierarchy(mesh, std::vector<int>{0}, by_centricity({1, 1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, 0}), by_centricity({1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, -1}), by_centricity({1, 1})), InputError);
  EXPECT_THROW(part_hierarchy(mesh, twice<int>({0, 2}), by_centricity({1, 1})), InputError);
  Mesh flat = mesh;
  flat.vertices.setZero();
  EXPECT_THROW(part_hierarchy(flat, twice<int>({0, 0}), by_centricity({1, 1})), InputError);
}

}  // namespace
}  // namespace partwise
