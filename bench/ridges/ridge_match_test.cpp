#include "bench/ridges/ridge_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace partwise::bench {
namespace {

Ridge box(const Point& low, const Point& high) {
  Ridge corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
  return corners;
}

Ridge at(double x) { return {Point(x, 0, 0)}; }

TEST(RidgeMatch, DistanceToABoxIsThatOfItsClosedForm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const Point low(-1, -0.5, -0.1), high(0.7, 0.4, 0.2);
  Ridge corners = box(low, high);
  for (int k = 0; k < 60; ++k) corners.push_back(low + (high - low) * (k % 8) / 8);  // inside: they change nothing
  for (int k = 0; k < 2000; ++k) {
    const Point p(uniform(random), uniform(random), uniform(random));
    EXPECT_NEAR(distance_to_hull(p, corners), (p - p.cwiseMax(low).cwiseMin(high)).norm(), 1e-8) << p;
  }
}

TEST(RidgeMatch, DistanceToPointsSegmentsAndFlatHulls) {
  EXPECT_DOUBLE_EQ(distance_to_hull({3, 4, 0}, at(0)), 5);
  EXPECT_EQ(distance_to_hull({0, 0, 0}, at(0)), 0);
  EXPECT_NEAR(distance_to_hull({0.3, 2, 0}, {Point(0, 0, 0), Point(1, 0, 0), Point(0.5, 0, 0)}), 2, 1e-9);
  EXPECT_NEAR(distance_to_hull({0.2, 0.2, 2}, {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0)}), 2,
              1e-9);
}

TEST(RidgeMatch, ReachHasADirection) {
  const Ridge small = box({0, 0, 0}, {1, 1, 1}), large = box({0, 0, 0}, {1, 1, 3});
  EXPECT_EQ(reach_out(small, large), 0);
  EXPECT_NEAR(reach_out(large, small), 2, 1e-9);
  // Not at the same place, though one contains the other.
  EXPECT_EQ(match_ridges({small}, {large}, 1.9).matched, 0);
  EXPECT_EQ(match_ridges({small}, {large}, 2.1).matched, 1);
}

TEST(RidgeMatch, MatchesAsManyAsCanBe) {
  // The first could take either, the second only the one that lies nearest to the first: greedily one would be left.
  const RidgeMatch match = match_ridges({at(0.5), at(0)}, {at(0.4), at(1.2)}, 0.75);
  EXPECT_EQ(match.matched, 2);
  EXPECT_EQ(match.partner, (std::vector<int>{1, 0}));
}

TEST(RidgeMatch, IsOneToOne) {
  EXPECT_EQ(match_ridges({at(0), at(0.1)}, {at(0)}, 1).matched, 1);
  EXPECT_EQ(match_ridges({at(0)}, {at(0.1), at(0)}, 1).matched, 1);
  EXPECT_EQ(match_ridges({at(0)}, {}, 1).matched, 0);
  EXPECT_EQ(match_ridges({at(0)}, {at(2)}, 1).matched, 0);
}

}  // namespace
}  // namespace partwise::bench
