#include "partwise/geometry/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

std::vector<int> one_by_one(const Vertices& points, const Mesh& hull) {
  const auto planes = hull_planes(hull);
  std::vector<int> inside;
  for (int i = 0; i < points.rows(); ++i)
    if (((planes.leftCols<3>() * points.row(i).transpose()).array() <= planes.col(3).array()).all())
      inside.push_back(i);
  return inside;
}

std::vector<int> by_tree(const PointTree& tree, const Mesh& hull) {
  std::vector<int> inside = tree.inside(hull);
  std::sort(inside.begin(), inside.end());
  return inside;
}

TEST(PointTree, FindsWhatAskingEveryPointFinds) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> size(0.01, 1.5), shift(-1, 1);
  for (int count : {1, 7, 8, 9, 100, 3000}) {
    const Vertices points = test::cloud(test::Cloud::box, count, random);
    const PointTree tree(points);
    ASSERT_EQ(tree.size(), count);
    std::size_t found = 0;
    for (int trial = 0; trial < 50; ++trial) {
      Vertices corners = size(random) * test::cloud(test::Cloud::sphere, 4 + 8 * trial, random);
      corners.rowwise() += Point(shift(random), shift(random), shift(random));
      const Mesh hull = convex_hull(corners, 1e-6).mesh;
      const std::vector<int> expected = one_by_one(points, hull);
      EXPECT_EQ(by_tree(tree, hull), expected);
      found += expected.size();
    }
    if (count > 9) {
      EXPECT_GT(found, 0u);
    }
  }
}

TEST(PointTree, EqualPointsAndNone) {
  const Mesh hull = test::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_TRUE(PointTree().inside(hull).empty());
  EXPECT_TRUE(PointTree(Vertices(0, 3)).inside(hull).empty());
  Vertices equal = Vertices::Constant(100, 3, 0.5);
  equal.row(99) << 2, 0, 0;
  std::vector<int> inside(99);
  std::iota(inside.begin(), inside.end(), 0);
  EXPECT_EQ(by_tree(PointTree(equal), hull), inside);
}

TEST(PointTree, PointsOnTheHullAreInside) {
  const Mesh cube = test::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(PointTree(cube.vertices).inside(cube).size(), 8u);
}

}  // namespace
}  // namespace partwise
