#include "partwise/parts/solid/concavity_polygon.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include "partwise/parts/planar/planar_hull.h"

namespace partwise {
namespace {

// (2.6) divided by the bridge's length.
TEST(FlattenValley, GoldenExample) {
  const std::vector<Point> path{{1, 1, 0}, {0, 1, 2}, {3, 1, -4}, {6, 5, 0}, {5, 1, 0}};
  const std::vector<Point2> flat = flatten_valley(path);
  const std::vector<Point2> expected{{0, 0}, {-1, std::sqrt(5.0)}, {2, 4}, {5, std::sqrt(17.0)}, {4, 0}};
  ASSERT_EQ(flat.size(), expected.size());
  for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_NEAR((flat[i] - expected[i]).norm(), 0, 1e-14) << i;
}

TEST(FlattenValley, MovesAndTurnsChangeNothingScaleScales) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 50; ++round) {
    std::vector<Point> path(6), other;
    for (Point& p : path) p = Point(normal(random), normal(random), normal(random));
    const Eigen::Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                                     .normalized()
                                     .toRotationMatrix();
    for (const Point& p : path) other.emplace_back(100 * (p * turn) + Point(5, 6, 7));
    const auto flat = flatten_valley(path), flat_other = flatten_valley(other);
    for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_NEAR((100 * flat[i] - flat_other[i]).norm(), 0, 1e-10);
    EXPECT_EQ(flat.front(), Point2(0, 0));
    EXPECT_EQ(flat.back().y(), 0);
    EXPECT_NEAR(flat.back().x(), (path.back() - path.front()).norm(), 1e-14);
  }
}

TEST(FlattenValley, BridgeWithoutLength) {
  const std::vector<Point> path{{1, 1, 1}, {1, 1, 4}, {1, 1, 1}};
  EXPECT_EQ(flatten_valley(path), (std::vector<Point2>{{0, 0}, {0, 3}, {0, 0}}));
}

// A polyline over the base that never turns back.
std::vector<Point2> random_chain(int size, std::mt19937_64& random, bool bowl = false) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point2> chain{{0, 0}};
  for (int i = 1; i < size; ++i) chain.emplace_back(chain.back().x() + 0.02 + unit(random), 3 * unit(random));
  const double length = chain.back().x();
  for (Point2& p : chain)
    if (bowl) p.y() = 0.3 * p.y() + 8 * p.x() * (length - p.x()) / (length * length);
  chain.back().y() = 0;
  return chain;
}

TEST(ValleyConcavity, ChainsThatNeverTurnBackAreMeasuredByHeight) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Point2> chain = random_chain(3 + round, random);
    const std::vector<double> concavity = valley_concavity(chain, 0.1);
    for (std::size_t i = 0; i < chain.size(); ++i) EXPECT_EQ(concavity[i], chain[i].y());
  }
}

// Lengths of shortest paths to the base inside the polygon on a fine grid whose steps go up to three cells each way.
std::vector<double> grid_concavity(const std::vector<Point2>& chain, double cell) {
  Point2 low(0, 0), high(0, 0);
  for (const Point2& p : chain) low = low.cwiseMin(p), high = high.cwiseMax(p);
  low.array() -= cell;
  high.array() += cell;
  const int width = static_cast<int>((high.x() - low.x()) / cell) + 1,
            height = static_cast<int>((high.y() - low.y()) / cell) + 1;
  const auto at = [&](int i) { return Point2(low.x() + cell * (i % width), low.y() + cell * (i / width)); };
  const auto inside = [&](const Point2& p) {
    bool in = false;
    for (std::size_t i = 0, j = chain.size() - 1; i < chain.size(); j = i++) {
      if ((chain[i].y() > p.y()) == (chain[j].y() > p.y())) continue;
      if (p.x() < chain[i].x() + (p.y() - chain[i].y()) / (chain[j].y() - chain[i].y()) * (chain[j].x() - chain[i].x()))
        in = !in;
    }
    return in;
  };
  std::vector<char> free(static_cast<std::size_t>(width * height));
  for (int i = 0; i < width * height; ++i) free[i] = inside(at(i));
  std::vector<double> distance(free.size(), 1e300);
  using Queued = std::pair<double, int>;
  std::priority_queue<Queued, std::vector<Queued>, std::greater<>> queue;
  const double length = chain.back().x();
  for (int i = 0; i < width * height; ++i)
    if (free[i] && at(i).y() <= cell) queue.push({distance[i] = distance_to_segment(at(i), {0, 0}, {length, 0}), i});
  while (!queue.empty()) {
    const auto [d, i] = queue.top();
    queue.pop();
    if (d > distance[i]) continue;
    for (int dx = -3; dx <= 3; ++dx)
      for (int dy = -3; dy <= 3; ++dy) {
        const int x = i % width + dx, y = i / width + dy;
        if (x < 0 || y < 0 || x >= width || y >= height || !free[y * width + x]) continue;
        if (!free[(y - dy / 2) * width + x - dx / 2]) continue;
        const double further = d + cell * std::hypot(dx, dy);
        if (further < distance[y * width + x]) queue.push({distance[y * width + x] = further, y * width + x});
      }
  }
  std::vector<double> result;
  for (const Point2& p : chain) {
    double least = p.y() == 0 ? 0 : 1e300;
    for (int i = 0; i < width * height; ++i)
      if (free[i] && (at(i) - p).norm() < 3 * cell) least = std::min(least, distance[i] + (at(i) - p).norm());
    result.push_back(least);
  }
  return result;
}

TEST(ValleyConcavity, ChainsThatTurnBackAreMeasuredByShortestPaths) {
  const std::vector<std::vector<Point2>> chains{
      {{0, 0}, {1, 2}, {3, 3}, {2, 1.5}, {4, 0}},                              // a beak
      {{0, 0}, {-1, 1}, {-1.5, 3}, {2, 4}, {5, 2}, {4, 0}},                    // overhanging either end
      {{0, 0}, {1, 1}, {1, 2}, {-1, 2}, {-1, 3}, {3, 3}, {3, 0}},              // a branch to the left
      {{0, 0}, {0, 1}, {3, 1}, {3, 1.4}, {-2, 1.4}, {-2, 3}, {4, 3}, {4, 0}},  // a shelf, and a room behind it
      {{0, 0}, {1, 3}, {2, 3}, {1.6, 2}, {2.4, 2}, {2.2, 3}, {3, 3}, {4, 0}}};
  for (const auto& chain : chains) {
    const std::vector<double> concavity = valley_concavity(chain, 100), grid = grid_concavity(chain, 0.02);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      EXPECT_NEAR(concavity[i], grid[i], 0.05 + 0.02 * grid[i]) << i << " of " << chain.size();
      EXPECT_GE(concavity[i], distance_to_segment(chain[i], chain.front(), chain.back()) - 1e-12);
    }
  }
}

TEST(ValleyConcavity, BehindAShelfInClosedForm) {
  // The corner (0, 3) is seen past the shelf's end (2, 1) only.
  const std::vector<Point2> chain{{0, 0}, {0, 0.9}, {2, 0.9}, {2, 1}, {0, 1}, {0, 3}, {4, 3}, {4, 0}};
  const std::vector<double> concavity = valley_concavity(chain, 100);
  EXPECT_NEAR(concavity[5], std::hypot(2, 2) + 1, 1e-12);
  EXPECT_NEAR(concavity[4], 2 + 1, 1e-12);
  EXPECT_NEAR(concavity[6], 3, 1e-12);
}

TEST(ValleyConcavity, CrossingsAndDeepBulgesGoToTheHierarchy) {
  const std::vector<Point2> crossing{{0, 0}, {3, 2}, {3, 3}, {1, 0.5}, {4, 0}},
      bulging{{0, 0}, {-2, 3}, {2, 1}, {1.9, 4}, {6, 4}, {5, 0}};
  EXPECT_EQ(valley_concavity(crossing, 100), hierarchical_concavity(crossing, 100));
  EXPECT_EQ(valley_concavity(bulging, 0.1), hierarchical_concavity(bulging, 0.1));
}

// (2.8) from its definition: the lids of a prefix are its hull's edges (i, j) that leave the prefix on their left, by
// trying all pairs.
double brute_prefix(const std::vector<Point2>& chain, std::size_t k) {
  double concavity = 0;
  for (std::size_t i = 0; i <= k; ++i)
    for (std::size_t j = i + 2; j <= k; ++j) {
      bool lid = true;
      for (std::size_t m = 0; m <= k && lid; ++m) lid = cross(chain[j] - chain[i], chain[m] - chain[i]) >= 0;
      if (!lid) continue;
      for (std::size_t m = i + 1; m < j; ++m)
        concavity = std::max(concavity, distance_to_segment(chain[m], chain[i], chain[j]));
    }
  return concavity;
}

std::vector<Point2> mirrored(const std::vector<Point2>& chain) {
  std::vector<Point2> back(chain.rbegin(), chain.rend());
  for (Point2& p : back) p.x() = chain.back().x() - p.x();
  return back;
}

double brute_residual(const std::vector<Point2>& chain, std::size_t k) {
  return std::max(brute_prefix(chain, k), brute_prefix(mirrored(chain), chain.size() - 1 - k));
}

TEST(PrefixConcavity, EqualsTheDefinition) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Point2> chain = random_chain(2 + round % 20, random, round % 2);
    for (std::size_t k = 0; k < chain.size(); ++k) {
      EXPECT_NEAR(prefix_concavity(chain, k), brute_prefix(chain, k), 1e-12);
    }
  }
}

// The lemma's monotony, where no edge grows steeper: on one wall of a bowl.
TEST(PrefixConcavity, NeverFallsAlongAConvexWall) {
  std::vector<Point2> wall;
  for (int i = 0; i <= 30; ++i) wall.emplace_back(i, 30 - std::sqrt(900.0 - i * i) + (i % 3) * 0.2);
  for (std::size_t k = 1; k < wall.size(); ++k)
    EXPECT_GE(prefix_concavity(wall, k), prefix_concavity(wall, k - 1) - 1e-12);
}

TEST(ResidualConcavity, SameFromEitherEnd) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 30; ++round) {
    const std::vector<Point2> chain = random_chain(2 + round, random, true);
    const std::vector<Point2> back = mirrored(chain);
    for (std::size_t k = 0; k < chain.size(); ++k)
      EXPECT_NEAR(residual_concavity(chain, k), residual_concavity(back, chain.size() - 1 - k), 1e-12);
  }
}

// Splitting at the deepest vertex does not always leave shallow valleys.
TEST(ValleySeparators, TheDeepestVertexIsNotAlwaysTheBest) {
  const std::vector<Point2> chain{{0, 0}, {2.75, 1.001}, {3.9, 1}, {4, 0}};
  EXPECT_NEAR(residual_concavity(chain, 1), 0.718, 1e-3);
  EXPECT_NEAR(residual_concavity(chain, 2), 0.287, 1e-3);
  const ValleySeparators split = valley_separators(chain, 0.3);
  EXPECT_TRUE(split.v_shaped());
  EXPECT_EQ(split.first, 2u);
}

TEST(ValleySeparators, VAndUShapes) {
  std::vector<Point2> v, u;
  for (int i = 0; i <= 10; ++i) v.emplace_back(i, i <= 5 ? 2 * i : 2 * (10 - i));
  EXPECT_EQ(valley_separators(v, 0.5).first, 5u);
  EXPECT_TRUE(valley_separators(v, 0.5).v_shaped());

  for (int i = 0; i < 10; ++i) u.emplace_back(0.01 * i, i);  // two walls and a floor of length 20
  for (int i = 0; i <= 20; ++i) u.emplace_back(0.1 + i, 10);
  for (int i = 9; i >= 0; --i) u.emplace_back(20.2 - 0.01 * i, i);
  const ValleySeparators split = valley_separators(u, 1);
  EXPECT_FALSE(split.v_shaped());
  EXPECT_EQ(split.first, 10u);  // where the walls meet the floor
  EXPECT_EQ(split.second, 30u);
}

// Prefixes whose concavity falls for once can mislead the search, on few of these jagged chains.
TEST(ValleySeparators, LeastResidualConcavityOfAllVertices) {
  std::mt19937_64 random(5);
  int missed = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::vector<Point2> chain = random_chain(3 + round % 25, random, round % 2);
    double least = 1e300;
    for (std::size_t k = 0; k < chain.size(); ++k) least = std::min(least, brute_residual(chain, k));
    const ValleySeparators split = valley_separators(chain, least + 1e-9);
    missed += !split.v_shaped() || brute_residual(chain, split.first) > least + 1e-12;
  }
  EXPECT_LE(missed, 20);
}

TEST(ValleySeparators, EndsOfAUShapeAreShallow) {
  std::mt19937_64 random(6);
  int u_shaped = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Point2> chain = random_chain(4 + round % 40, random, round % 2);
    for (double tolerance : {0.1, 0.4, 1.0}) {
      const ValleySeparators split = valley_separators(chain, tolerance);
      ASSERT_LE(split.first, split.second);
      ASSERT_LT(split.second, chain.size());
      if (split.v_shaped()) continue;
      ++u_shaped;
      EXPECT_GT(split.first, 0u);
      EXPECT_LT(split.second, chain.size() - 1);
      EXPECT_LT(brute_prefix(chain, split.first), tolerance);
      EXPECT_LT(brute_prefix(mirrored(chain), chain.size() - 1 - split.second), tolerance);
    }
  }
  EXPECT_GT(u_shaped, 100);
}

TEST(ValleySeparators, ShortestValleys) {
  const std::vector<Point2> edge{{0, 0}, {1, 0}}, corner{{0, 0}, {0.5, 3}, {1, 0}};
  EXPECT_TRUE(valley_separators(edge, 0.1).v_shaped());
  EXPECT_EQ(valley_separators(corner, 0.1).first, 1u);
  EXPECT_TRUE(valley_separators(corner, 0.1).v_shaped());
}

}  // namespace
}  // namespace partwise
