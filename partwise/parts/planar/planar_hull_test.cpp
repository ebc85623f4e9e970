#include "partwise/parts/planar/planar_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace partwise {
namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(PlanarHull, SquareWithPointsOnItsEdgesAndRepeats) {
  const Points points{{1, 1}, {0, 1}, {0.5, 0}, {0, 0}, {1, 0}, {0, 0}, {0.5, 0.5}, {1, 0.5}, {1, 1}};
  EXPECT_EQ(planar_hull(points), (std::vector<int>{3, 4, 0, 1}));
}

TEST(PlanarHull, FewAndCollinearPoints) {
  EXPECT_TRUE(planar_hull(Points{}).empty());
  EXPECT_EQ(planar_hull(Points{{2, 3}}), std::vector<int>{0});
  EXPECT_EQ(planar_hull(Points{{2, 3}, {2, 3}, {2, 3}}), std::vector<int>{0});
  EXPECT_EQ(planar_hull(Points{{2, 3}, {1, 3}}), (std::vector<int>{1, 0}));
  EXPECT_EQ(planar_hull(Points{{0, 0}, {2, 2}, {1, 1}, {3, 3}}), (std::vector<int>{0, 3}));
  EXPECT_EQ(planar_hull(Points{{0, 2}, {0, 0}, {0, 1}}), (std::vector<int>{1, 0}));
}

// A point is a corner when some line through it and another point has all the rest strictly on one side, or beyond it.
// On small integers everything is exact.
TEST(PlanarHull, EqualsBruteForceOnGridPoints) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    std::uniform_int_distribution<int> coordinate(0, round % 2 ? 4 : 20);
    Points points(3 + round % 20);
    for (auto& p : points) p = {coordinate(random), coordinate(random)};
    const std::vector<int> hull = planar_hull(points);
    Points corners;
    for (int i : hull) corners.push_back(points[i]);
    if (hull.size() >= 3) {
      for (std::size_t h = 0; h < corners.size(); ++h) {
        const auto &a = corners[h], &b = corners[(h + 1) % corners.size()], &c = corners[(h + 2) % corners.size()];
        EXPECT_GT(cross(b - a, c - b), 0);
        for (const auto& p : points) EXPECT_GE(cross(b - a, p - a), 0);
      }
    }
    const auto lower = [](const auto& p, const auto& q) { return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y(); };
    EXPECT_EQ(corners.front(), *std::min_element(points.begin(), points.end(), lower));
    EXPECT_TRUE(std::find(corners.begin(), corners.end(), *std::max_element(points.begin(), points.end(), lower)) !=
                corners.end());
  }
}

}  // namespace
}  // namespace partwise
