#include "partwise/parts/planar/complement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "partwise/parts/planar/dual_decomposition.h"
#include "partwise/parts/planar/resolvers.h"

namespace partwise {
namespace {

Complement measure(std::span<const Point2> points, const Region& region, double tolerance) {
  return measure_complement(points, region, tolerance, [&](const Region& outside) {
    return dual_decomposition(points, outside, {tolerance, 10}).parts;
  });
}

IndexRing count_up(int n) {
  IndexRing ring;
  for (int i = 0; i < n; ++i) ring.push_back(i);
  return ring;
}

// A block with a winding corridor cut into its top: down, to the right, and up again inside.
const std::vector<Point2> corridor{{0, 0},  {20, 0}, {20, 10}, {4, 10}, {4, 4},  {15, 4},
                                   {15, 8}, {17, 8}, {17, 2},  {2, 2},  {2, 10}, {0, 10}};

TEST(Complement, BridgesFormATreeAndPocketsNest) {
  const Region region{count_up(12), {}};
  const Complement complement = measure(corridor, region, 0.5);
  ASSERT_GE(complement.chambers.size(), 3u);
  std::set<int> roots;
  for (std::size_t c = 0; c < complement.chambers.size(); ++c) {
    const int bridge = complement.chambers[c].bridge;
    const int parent = complement.hierarchy.parent(bridge);
    EXPECT_LT(parent, bridge);  // so that there is no cycle
    if (parent < 0) {
      roots.insert(bridge);
      continue;
    }
    // The bridge is a side of its own chamber and, the other way round, of the chamber above.
    const IndexRing& own = complement.chambers[c].ring;
    const auto above = std::find_if(complement.chambers.begin(), complement.chambers.end(),
                                    [&](const Chamber& chamber) { return chamber.bridge == parent; });
    ASSERT_NE(above, complement.chambers.end());
    int shared = 0;
    for_each_edge(above->ring, [&](int a, int b) { shared += a == own[1] && b == own[0] ? 1 : 0; });
    EXPECT_EQ(shared, 1);
  }
  EXPECT_EQ(roots.size(), 1u);  // one pocket on the hull
  // Concavity accumulates along the corridor, beyond the straight distance to its mouth.
  EXPECT_GT(complement.vertices.at(6).value, 10);
  EXPECT_GT(complement.vertices.at(6).value, 2 * (10 - corridor[6].y()));
  EXPECT_TRUE(complement.features.contains(9));
  for (const auto& [vertex, concavity] : complement.features) EXPECT_GT(concavity, 0.5) << vertex;
}

TEST(Complement, ConvexRegionHasNone) {
  const std::vector<Point2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Complement complement = measure(square, {count_up(4), {}}, 0.01);
  EXPECT_TRUE(complement.chambers.empty());
  EXPECT_TRUE(complement.features.empty());
  EXPECT_EQ(complement.depth, 0);
}

TEST(Complement, NearlyConvexHoleHangsBelowItsAntipodes) {
  const std::vector<Point2> points{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {3, 4}, {3, 6}, {7, 6}, {7, 4}};
  const Region region{{0, 1, 2, 3}, {{4, 5, 6, 7}}};
  const double depth = 8 / std::hypot(4, 2);  // of the other corners beneath the diagonal
  const Complement complement = measure(points, region, 0.5);
  EXPECT_DOUBLE_EQ(complement.depth, depth);
  EXPECT_FALSE(complement.noise[0]);
  EXPECT_EQ(complement.features.size(), 4u);  // the antipodes and what the hull needs
  EXPECT_EQ(complement.simplified.size(), 2u);
  const Complement coarse = measure(points, region, 2);
  EXPECT_TRUE(coarse.noise[0]);
  EXPECT_TRUE(coarse.features.empty());
}

TEST(Complement, BentHoleIsRootedWhereItsTreeIsLeastDeep) {
  // A hole like a U: its parts are two legs and the bar between them. The root must be a cut, each side one deep or
  // two.
  const std::vector<Point2> points{{0, 0},   {20, 0},  {20, 20}, {0, 20}, {5, 5},  {15, 5},
                                   {15, 15}, {13, 15}, {13, 7},  {7, 7},  {7, 15}, {5, 15}};
  Region region{{0, 1, 2, 3}, {{11, 10, 9, 8, 7, 6, 5, 4}}};
  const Complement complement = measure(points, region, 0.5);
  EXPECT_GE(complement.chambers.size(), 3u);
  int roots = 0;
  for (const Chamber& chamber : complement.chambers) {
    EXPECT_EQ(chamber.hole, 0);
    roots += complement.hierarchy.parent(chamber.bridge) < 0 ? 1 : 0;
  }
  EXPECT_EQ(roots, 2);  // the chambers on both sides of one cut
}

TEST(Resolvers, SinglesAndPairsOfAReflexCorner) {
  // A corner of 270 degrees at the origin, inside from +x counter-clockwise to -y.
  const Corner corner{{0, 0}, {2, 0}, {0, -2}};
  EXPECT_TRUE(needs_resolver(corner, 0.1));
  EXPECT_FALSE(needs_resolver(corner, 1.5));  // sqrt(2) from the chord
  const std::vector<Eigen::Vector2d> ends{{-1, 1}, {1, 3}, {-3, -1}, {3, -3}};
  const auto sets = smallest_resolvers(corner, ends, 0.1);
  // The bisector does alone; so does no other but with help of the second on the other side. The last is outside.
  EXPECT_EQ(sets, (std::vector<std::vector<int>>{{0}, {1, 2}}));
}

TEST(Resolvers, ResidualConcavityIsTheDistanceToTheChord) {
  const Corner corner{{0, 0}, {2, 0}, {0, -2}};
  const std::vector<Eigen::Vector2d> slanted{{1, 0.2}};  // leaves a wedge of more than half a turn
  const double residual = std::abs(1 * (-2 - 0.2) * 0 + 1 * 2.0) / std::hypot(1, 2.2) * 1.0;  // origin to (1,.2)(0,-2)
  EXPECT_FALSE(resolves(corner, slanted, 0.99 * residual));
  EXPECT_TRUE(resolves(corner, slanted, 1.01 * residual));
}

}  // namespace
}  // namespace partwise
