#include "partwise/parts/solid/cup_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

constexpr double kHeight = 1.5, kWall = 0.1;

struct Cup {
  Mesh mesh = test::cup(1, kHeight, kWall, 32);
  SurfaceQuery surface{mesh};
  PartGraph part = part_graph(mesh, test::all_faces(mesh));
  PartHull hull = part_hull(part, 0.1);
  Hollows hollows{part, hull, 0.1, false};
  Bridges bridges = find_bridges(part, part_hull(part, 0.1), surface, 0.2);
};

// From the rim below every bridge across the mouth, over the lip and down.
TEST(Hollows, WalksReachTheBottomOfACup) {
  const Cup cup;
  EXPECT_TRUE(cup.bridges.deep.empty());
  ASSERT_GT(cup.bridges.rims.size(), 10u);
  for (const Valley& rim : cup.bridges.rims) {
    const int a = rim.path.front(), b = rim.path.back();
    EXPECT_EQ(cup.part.positions(rim.deepest, 2), kHeight);
    EXPECT_NEAR(cup.hollows.depth(rim.deepest, a, b), 0, 1e-12);
    const Hollows::Bottom bottom = cup.hollows.descend(rim.deepest, a, b);
    EXPECT_NEAR(bottom.depth, kHeight - kWall, 1e-12);
    EXPECT_NEAR(cup.part.positions(bottom.vertex, 2), kWall, 1e-12);
  }
}

TEST(Hollows, NoWalkLeadsDownTheOutside) {
  const Cup cup;
  ASSERT_FALSE(cup.bridges.rims.empty());
  const Valley& rim = cup.bridges.rims.front();
  int outside = 0;
  for (int v = 0; v < cup.part.size(); ++v) {
    const Point p = cup.part.positions.row(v);
    if (p.head<2>().norm() < 1 - kWall / 2 || p.z() > kHeight - 0.2) continue;
    const Hollows::Bottom bottom = cup.hollows.descend(v, rim.path.front(), rim.path.back());
    EXPECT_EQ(bottom.vertex, v);
    EXPECT_EQ(bottom.depth, 0);
    ++outside;
  }
  EXPECT_GT(outside, 32);
}

// On an open mesh nobody knows which side is outside: turned either way, the walk finds the bottom of a bowl.
TEST(Hollows, OfOpenMeshesAreOnEitherSide) {
  Mesh bowl = test::open_cup(1, kHeight, 32);
  for (int turn = 0; turn < 2; ++turn) {
    const SurfaceQuery surface(bowl);
    const PartGraph part = part_graph(bowl, test::all_faces(bowl));
    const Bridges bridges = find_bridges(part, part_hull(part, 0.1), surface, 0.2, {.on = true, .two_sided = true});
    ASSERT_FALSE(bridges.deep.empty());
    EXPECT_NEAR(part.positions(bridges.deep.front().deepest, 2), 0, 1e-12);
    bowl.faces.col(0).swap(bowl.faces.col(1));
  }
}

TEST(PathThrough, IsAsLongAsTheTwoShortest) {
  const Mesh mesh = test::torus(1, 0.3, 36, 18);
  const PartGraph part = part_graph(mesh, test::all_faces(mesh));
  PathSearch search(part);
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> vertex(0, part.size() - 1);
  for (int i = 0; i < 50; ++i) {
    const int a = vertex(random), via = vertex(random), b = vertex(random);
    const std::vector<int> path = path_through(search, a, via, b);
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front(), a);
    EXPECT_EQ(path.back(), b);
    EXPECT_NE(std::find(path.begin(), path.end(), via), path.end());
    double length = 0;
    for (std::size_t k = 1; k < path.size(); ++k) {
      const auto begin = part.steps.begin() + part.first[path[k - 1]],
                 end = part.steps.begin() + part.first[path[k - 1] + 1];
      const auto step = std::find_if(begin, end, [&](const PartGraph::Step& s) { return s.to == path[k]; });
      ASSERT_NE(step, end);
      length += step->length;
    }
    constexpr double kAny = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(length, search.bounded_length(a, via, kAny) + search.bounded_length(via, b, kAny), 1e-12);
  }
}

TEST(FindBridges, LeadsTheRimOfACupThroughItsBottom) {
  const Cup cup;
  const Bridges repaired = find_bridges(cup.part, part_hull(cup.part, 0.1), cup.surface, 0.2, {.on = true});
  EXPECT_TRUE(repaired.rims.empty());
  ASSERT_EQ(repaired.deep.size(), cup.bridges.rims.size());
  for (const Valley& v : repaired.deep) {
    EXPECT_TRUE(v.through_hollow);
    EXPECT_GE(v.concavity, kHeight - kWall - 1e-12);
    double lowest = kHeight;
    for (int p : v.path) lowest = std::min(lowest, cup.part.positions(p, 2));
    EXPECT_NEAR(lowest, kWall, 1e-12);
  }
}

// Rims about a hollow that is shallower than the tolerance stay rims, but its depth is reported.
TEST(FindBridges, LeavesShallowHollowsAlone) {
  const Mesh mesh = test::cup(1, 0.8, 0.1, 32);
  const SurfaceQuery surface(mesh);
  const PartGraph part = part_graph(mesh, test::all_faces(mesh));
  const Bridges plain = find_bridges(part, part_hull(part, 0.1), surface, 0.8),
                repaired = find_bridges(part, part_hull(part, 0.1), surface, 0.8, {.on = true});
  EXPECT_TRUE(repaired.deep.empty());
  EXPECT_FALSE(repaired.rims.empty());
  EXPECT_EQ(repaired.rims.size(), plain.rims.size());
  EXPECT_GE(repaired.concavity, 0.7 - 1e-12);
  EXPECT_LE(repaired.concavity, 0.8);
}

}  // namespace
}  // namespace partwise
