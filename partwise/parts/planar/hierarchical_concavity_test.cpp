#include "partwise/parts/planar/hierarchical_concavity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace partwise {
namespace {

TEST(SegmentDistance, ClosedForms) {
  EXPECT_DOUBLE_EQ(distance_to_segment({0, 2}, {-1, 0}, {1, 0}), 2);
  EXPECT_DOUBLE_EQ(distance_to_segment({4, 4}, {-1, 0}, {1, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_to_segment({3, 4}, {0, 0}, {0, 0}), 5);
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0}, {1, 0}, {0, -1}, {0, 1}), 0);  // crossing
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0}, {1, 0}, {0, 0}, {0, 1}), 0);   // touching
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0}, {1, 0}, {-3, 2}, {3, 2}), 2);  // parallel
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0}, {1, 0}, {4, 4}, {9, 12}), 5);  // end to end
  EXPECT_DOUBLE_EQ(segment_distance({0, 0}, {2, 0}, {3, 0}, {5, 0}), 1);    // on one line
}

TEST(SegmentDistance, EqualsTheLeastOverSampledPoints) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(-1, 1);
  const auto point = [&] { return Point2(side(random), side(random)); };
  for (int round = 0; round < 200; ++round) {
    const Point2 a = point(), b = point(), c = point(), d = point();
    double least = 1e300;
    for (int i = 0; i <= 400; ++i) least = std::min(least, distance_to_segment(a + i / 400.0 * (b - a), c, d));
    EXPECT_LE(segment_distance(a, b, c, d), least + 1e-12);
    EXPECT_GE(segment_distance(a, b, c, d), least - (b - a).norm() / 800 - 1e-12);
  }
}

TEST(BridgeHierarchy, DistancesAccumulateUpTheTree) {
  BridgeHierarchy tree;
  const int root = tree.add(-1, {0, 0}, {10, 0});
  const int child = tree.add(root, {4, 3}, {6, 3});
  const int grandchild = tree.add(child, {4, 5}, {4, 7});
  const int other = tree.add(root, {0, 2}, {1, 2});
  EXPECT_EQ(tree.size(), 4);
  for (int bridge : {child, grandchild, other}) EXPECT_LT(tree.parent(bridge), bridge);  // so that it is a tree
  EXPECT_EQ(tree.parent(root), -1);
  EXPECT_DOUBLE_EQ(tree.concavity(root, {5, 1}), 1);
  EXPECT_DOUBLE_EQ(tree.concavity(child, {5, 9}), 6 + 3);
  EXPECT_DOUBLE_EQ(tree.concavity(grandchild, {1, 6}), 3 + 2 + 3);
  EXPECT_DOUBLE_EQ(tree.concavity(other, {0.5, 2}), 2);
}

TEST(HierarchicalConcavity, StraightPocketIsMeasuredByHeight) {
  const std::vector<Point2> pocket{{0, 0}, {0, 3}, {1, 3.5}, {2, 4}, {3, 3}, {3, 0}};
  const std::vector<double> concavity = hierarchical_concavity(pocket, 0.1);
  for (std::size_t i = 0; i < pocket.size(); ++i) EXPECT_DOUBLE_EQ(concavity[i], pocket[i].y()) << i;
}

// A jar upside down: a neck of width 2 and height 3, a belly from x = -5 to 5 and from y = 3 to y = 9. The belly hangs
// below the bridge across the neck's upper end, 3 from the mouth (2.2).
TEST(HierarchicalConcavity, JarWithANarrowNeck) {
  const std::vector<Point2> jar{{-1, 0}, {-1, 3}, {-5, 3}, {-5, 9}, {5, 9}, {5, 3}, {1, 3}, {1, 0}};
  const std::vector<double> concavity = hierarchical_concavity(jar, 0.5);
  EXPECT_DOUBLE_EQ(concavity[0], 0);
  EXPECT_DOUBLE_EQ(concavity[1], 3);
  EXPECT_DOUBLE_EQ(concavity[2], 3 + 4);                 // from the corner along the belly's floor to the neck
  EXPECT_DOUBLE_EQ(concavity[3], 3 + std::hypot(4, 6));  // straight lines would say sqrt(4^2 + 9^2) = 9.85
  EXPECT_DOUBLE_EQ(concavity[4], concavity[3]);
  EXPECT_DOUBLE_EQ(concavity[5], concavity[2]);
  EXPECT_DOUBLE_EQ(concavity[6], 3);
  EXPECT_DOUBLE_EQ(concavity[7], 0);

  // A tolerance above what the neck bulges leaves one pocket: distances to the mouth.
  const std::vector<double> coarse = hierarchical_concavity(jar, 10);
  EXPECT_DOUBLE_EQ(coarse[3], std::hypot(4, 9));
}

// The shortest path inside a pocket is never shorter than the straight line to the mouth, which is what the sums bound.
TEST(HierarchicalConcavity, NeverBelowZeroAlwaysFiniteZeroAtTheBridge) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 500; ++round) {
    std::vector<Point2> pocket(static_cast<std::size_t>(2 + round % 40));
    Point2 at(0, 0);
    for (auto& p : pocket) p = at, at += Point2(normal(random), normal(random));
    if (round % 5 == 0) pocket[pocket.size() / 2] = pocket.front();  // It may touch, cross and repeat itself.
    if (round % 7 == 0) pocket.back() = pocket.front();
    for (double tolerance : {0.0, 0.3, 3.0}) {
      const std::vector<double> concavity = hierarchical_concavity(pocket, tolerance);
      ASSERT_EQ(concavity.size(), pocket.size());
      for (double c : concavity) {
        EXPECT_TRUE(std::isfinite(c));
        EXPECT_GE(c, 0);
      }
      EXPECT_EQ(concavity.front(), 0);
      EXPECT_EQ(concavity.back(), 0);
    }
  }
}

TEST(HierarchicalConcavity, SmallestPockets) {
  EXPECT_TRUE(hierarchical_concavity({}, 0.1).empty());
  const std::vector<Point2> one{{1, 2}}, two{{1, 2}, {3, 4}}, three{{0, 0}, {1, 2}, {2, 0}};
  EXPECT_EQ(hierarchical_concavity(one, 0.1), std::vector<double>{0});
  EXPECT_EQ(hierarchical_concavity(two, 0.1), (std::vector<double>{0, 0}));
  EXPECT_EQ(hierarchical_concavity(three, 0.1), (std::vector<double>{0, 2, 0}));
}

}  // namespace
}  // namespace partwise
