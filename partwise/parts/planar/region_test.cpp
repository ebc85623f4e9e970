#include "partwise/parts/planar/region.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partwise/parts/planar/part_joining.h"
#include "partwise/parts/planar/pockets.h"

namespace partwise {
namespace {

double area_of(std::span<const Point2> points, const Region& region) { return area(to_polygon(points, region)); }

std::vector<IndexEdge> edges_of(std::initializer_list<IndexRing> rings) {
  std::vector<IndexEdge> edges;
  for (const IndexRing& r : rings) for_each_edge(r, [&](int a, int b) { edges.emplace_back(a, b); });
  return edges;
}

// A square with a diamond-shaped hole that touches the outline at (4, 0).
const std::vector<Point2> touching{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 0}, {6, 2}, {4, 4}, {2, 2}};

TEST(TraceRegion, HoleThatTouchesTheOutline) {
  const Region region = trace_region(touching, edges_of({{0, 4, 1, 2, 3}, {4, 7, 6, 5}}));
  EXPECT_EQ(region.outer.size(), 5u);
  ASSERT_EQ(region.holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area_of(touching, region), 64 - 8);
}

TEST(TraceRegion, RefusesEdgesThatBoundNothing) {
  EXPECT_ANY_THROW(trace_region(touching, {{0, 1}, {1, 2}}));
  EXPECT_ANY_THROW(trace_region(touching, edges_of({{0, 3, 2, 1}})));  // clockwise: a hole of nothing
}

TEST(RegionMesh, SplitsAlongCuts) {
  const IndexRing outer{0, 4, 1, 2, 3}, hole{4, 7, 6, 5};
  const std::vector<const IndexRing*> rings{&outer, &hole};
  RegionMesh mesh(touching, rings);
  const auto cut = [&](std::initializer_list<IndexEdge> edges) {
    for (const auto& [a, b] : edges) EXPECT_TRUE(mesh.mesh().insert_edge(mesh.local(a), mesh.local(b)));
    return mesh.split(touching, [&, edges = std::vector<IndexEdge>(edges)](int a, int b) {
      return std::any_of(edges.begin(), edges.end(), [&](const IndexEdge& e) {
        return (mesh.point(a) == e.first && mesh.point(b) == e.second) ||
               (mesh.point(b) == e.first && mesh.point(a) == e.second);
      });
    });
  };
  // Where the hole touches the outline the ring is open already: each cut from the hole outwards makes one part more.
  EXPECT_EQ(cut({{6, 2}}).size(), 2u);
  const auto three = cut({{6, 2}, {7, 3}});
  ASSERT_EQ(three.size(), 3u);
  EXPECT_DOUBLE_EQ(area_of(touching, three[0]) + area_of(touching, three[1]) + area_of(touching, three[2]), 56);
}

TEST(Pockets, ChainsBetweenHullCorners) {
  const std::vector<Point2> points{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {2, 1}, {1, 4}, {0, 4}, {0, 2}};
  const auto pockets = hull_pockets(points, {0, 1, 2, 3, 4, 5, 6, 7});
  ASSERT_EQ(pockets.size(), 1u);
  EXPECT_EQ(pockets[0], (IndexRing{3, 4, 5}));
  EXPECT_DOUBLE_EQ(pocket_depth(points, pockets[0]), 3);
  EXPECT_EQ(hull_pockets(points, {5, 6, 7, 0, 1, 2, 3, 4}).size(), 1u);  // wherever the ring begins
}

TEST(Pockets, AntipodesOfRandomRings) {
  for (int n = 3; n < 60; ++n) {
    std::vector<Point2> points;
    IndexRing order;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n, radius = 1 + 0.5 * std::sin(7.0 * i * i);
      points.emplace_back(radius * std::cos(angle), 0.6 * radius * std::sin(angle));
      order.push_back(i);
    }
    if (n == 4) points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};  // parallel sides
    const AntipodalPair pair = antipodal_pair(points, order);
    double farthest = 0;
    for (const Point2& p : points) {
      for (const Point2& q : points) farthest = std::max(farthest, (p - q).norm());
    }
    EXPECT_DOUBLE_EQ((points[pair.a] - points[pair.b]).norm(), farthest) << n;
  }
}

TEST(ApproximateChain, IsSmallestByBruteForce) {
  std::vector<Point2> points;
  IndexRing chain;
  for (int i = 0; i <= 12; ++i) {
    const double angle = 3.141592653589793 * i / 12;
    points.emplace_back(std::cos(angle), (1 + 0.3 * std::cos(angle)) * std::sin(angle));
    chain.push_back(i);
  }
  for (double tolerance : {0.01, 0.03, 0.1, 0.3, 2.0}) {
    const auto error = [&](const std::vector<int>& kept) {
      IndexRing all{0};
      all.insert(all.end(), kept.begin(), kept.end());
      all.push_back(12);
      double worst = 0;
      for (std::size_t k = 0; k + 1 < all.size(); ++k) {
        worst =
            std::max(worst, pocket_depth(points, IndexRing(chain.begin() + all[k], chain.begin() + all[k + 1] + 1)));
      }
      return worst;
    };
    std::pair<std::size_t, double> best{99, 0};
    for (unsigned mask = 0; mask < (1u << 11); ++mask) {
      std::vector<int> kept;
      for (int i = 0; i < 11; ++i) {
        if (mask & (1u << i)) kept.push_back(i + 1);
      }
      if (const double e = error(kept); e <= tolerance) best = std::min(best, {kept.size(), e});
    }
    const std::vector<int> kept = approximate_chain(points, chain, tolerance);
    EXPECT_EQ(kept.size(), best.first);
    EXPECT_DOUBLE_EQ(error(kept), best.second);
  }
}

TEST(JoinParts, TakesBackNeedlessCutsOnly) {
  // Three unit squares in an L: two of them join to a rectangle, which the third cannot.
  const std::vector<Point2> points{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
  const std::vector<Region> squares{{{0, 1, 4, 7}, {}}, {{1, 2, 3, 4}, {}}, {{7, 4, 5, 6}, {}}};
  EXPECT_EQ(join_parts(points, squares, 0.1).size(), 2u);
  EXPECT_EQ(join_parts(points, squares, 0.8).size(), 1u);  // the L is sqrt(1/2) deep
}

// A cut from a hole to the outline alone divides nothing and is forgotten.
TEST(RegionMesh, ForgetsCutsThatDivideNothing) {
  const std::vector<Point2> points{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {3, 3}, {5, 3}, {5, 5}, {3, 5}};
  const IndexRing outer{0, 1, 2, 3}, hole{4, 7, 6, 5};
  const std::vector<const IndexRing*> rings{&outer, &hole};
  RegionMesh mesh(points, rings);
  ASSERT_TRUE(mesh.mesh().insert_edge(0, 4));
  const auto parts = mesh.split(points, [](int a, int b) { return a + b == 4 && a * b == 0; });
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area_of(points, parts[0]), 60);
}

}  // namespace
}  // namespace partwise
