#include "partwise/parts/solid/convex_ridges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

using test::block;

struct Found {
  explicit Found(const Mesh& shape, double tolerance_asked)
      : mesh(test::normalised(shape)),
        tolerance(tolerance_asked),
        surface(mesh),
        part(part_graph(mesh, test::all_faces(mesh))),
        bridges(find_bridges(part, part_hull(part, tolerance), surface, tolerance)),
        ridges(convex_ridges(part, bridges)) {}

  Mesh mesh;
  double tolerance;
  SurfaceQuery surface;
  PartGraph part;
  Bridges bridges;
  ConvexRidges ridges;
};

Mesh star() {  // six arms
  auto cells = block({-1, -1, -1}, {2, 2, 2});
  for (int axis = 0; axis < 3; ++axis) {
    test::Cell low{-1, -1, -1}, high{2, 2, 2};
    low[axis] = -5, high[axis] = 6;
    cells = test::united(cells, block(low, high));
  }
  return test::cells_mesh(cells);
}

std::vector<Mesh> shapes() {
  return {test::l_shape(10, 3), test::u_shape(12, 3),        star(),
          test::dumbbell(),     test::torus(1, 0.3, 36, 18), test::sheet(8, 4)};
}

// (2.7): the members of a ridge hang together by shallow valleys, and no deep one joins two of them. Greedy: no two
// ridges that a shallow valley joins could be one.
TEST(ConvexRidges, HoldWhatAlgorithm3Promises) {
  for (const Mesh& mesh : shapes())
    for (double tolerance : {0.03, 0.1, 0.2}) {
      const Found found(mesh, tolerance);
      const auto& of = found.ridges.of_vertex;
      std::map<std::pair<int, int>, int> deep;
      for (const Valley& v : found.bridges.deep) {
        EXPECT_GT(v.concavity, tolerance);
        EXPECT_FALSE(v.on_hull);
        const int a = of[v.path.front()], b = of[v.path.back()];
        ASSERT_GE(a, 0);
        ASSERT_GE(b, 0);
        EXPECT_NE(a, b);
        deep[std::minmax({a, b})] = 1;
      }
      std::vector<int> joined(of.size());  // union of members by shallow valleys within a ridge
      std::iota(joined.begin(), joined.end(), 0);
      const std::function<int(int)> root = [&](int v) { return joined[v] == v ? v : joined[v] = root(joined[v]); };
      for (const auto& s : found.bridges.shallow) {
        if (of[s.a] == of[s.b]) {
          joined[root(s.a)] = root(s.b);
        } else {
          EXPECT_TRUE(deep.contains(std::minmax({of[s.a], of[s.b]})));
        }
      }
      std::size_t members = 0;
      for (std::size_t r = 0; r < found.ridges.members.size(); ++r) {
        members += found.ridges.members[r].size();
        ASSERT_FALSE(found.ridges.members[r].empty());
        for (int v : found.ridges.members[r]) {
          EXPECT_EQ(of[v], static_cast<int>(r));
          EXPECT_EQ(root(v), root(found.ridges.members[r].front()));
        }
      }
      EXPECT_EQ(members, static_cast<std::size_t>(std::count_if(of.begin(), of.end(), [](int r) { return r >= 0; })));
    }
}

TEST(ConvexRidges, HasDeepValleyAgreesWithFindBridges) {
  for (const Mesh& mesh : shapes())
    for (double tolerance : {0.03, 0.1, 0.2, 0.5}) {
      const Found found(mesh, tolerance);
      EXPECT_EQ(has_deep_valley(found.part, part_hull(found.part, tolerance), found.surface, tolerance),
                !found.bridges.deep.empty());
      EXPECT_EQ(found.bridges.concavity > tolerance, !found.bridges.deep.empty());
    }
  std::vector<Mesh> hollow = shapes();
  hollow.push_back(test::cup(1, 1.5, 0.1, 24));
  hollow.push_back(test::open_cup(1, 0.4, 24));
  for (const Mesh& mesh : hollow)
    for (double tolerance : {0.03, 0.1, 0.2, 0.5}) {
      const Found found(mesh, tolerance);
      const CupRepair repair{.on = true};
      const Bridges bridges =
          find_bridges(found.part, part_hull(found.part, tolerance), found.surface, tolerance, repair);
      EXPECT_EQ(has_deep_valley(found.part, part_hull(found.part, tolerance), found.surface, tolerance, repair),
                !bridges.deep.empty());
      EXPECT_EQ(bridges.concavity > tolerance, !bridges.deep.empty());
      EXPECT_EQ(bridges.deep.size() + bridges.rims.size(), found.bridges.deep.size() + found.bridges.rims.size());
    }
}

TEST(ConvexRidges, ADumbbellHasTwo) {
  const Found found(test::dumbbell(), 0.1);
  ASSERT_EQ(found.ridges.members.size(), 2u);
  for (const auto& members : found.ridges.members) {
    const double z = found.part.positions(members.front(), 2);
    for (int v : members) EXPECT_GT(found.part.positions(v, 2) * z, 0);
  }
  EXPECT_NEAR(found.bridges.concavity, 0.7 / 3, 0.03);  // from the hull's side down to the bar
}

TEST(ConvexRidges, ConvexBodiesHaveOne) {
  for (const Mesh& mesh : {test::sphere(10, 20), test::cells_mesh(block({0, 0, 0}, {4, 2, 3}))}) {
    const Found found(mesh, 0.1);
    EXPECT_TRUE(found.bridges.deep.empty());
    EXPECT_EQ(found.ridges.members.size(), 1u);
    EXPECT_LE(found.bridges.concavity, 0.1);
  }
}

TEST(ConvexRidges, AnLHasTwoAndAStarAsManyAsArms) {
  EXPECT_EQ(Found(test::l_shape(10, 3), 0.1).ridges.members.size(), 2u);
  EXPECT_EQ(Found(star(), 0.1).ridges.members.size(), 6u);
}

TEST(ConvexRidges, StayPutUnderNoise) {
  std::mt19937_64 random(1);
  for (double noise : {0.002, 0.005, 0.01}) {
    Mesh mesh = test::dumbbell();
    mesh.vertices += 3 * noise * test::cloud(test::Cloud::box, static_cast<int>(mesh.vertices.rows()), random);
    const Found found(mesh, 0.1);
    ASSERT_EQ(found.ridges.members.size(), 2u) << noise;
    for (const auto& members : found.ridges.members)
      for (int v : members) EXPECT_GT(found.part.positions(v, 2) * found.part.positions(members.front(), 2), 0);
  }
}

// Valleys go from one end of a hull edge to the other along the part.
TEST(FindBridges, ValleysArePathsOverLinks) {
  const Found found(test::u_shape(12, 3), 0.1);
  ASSERT_FALSE(found.bridges.deep.empty());
  for (const Valley& v : found.bridges.deep) {
    ASSERT_EQ(v.path.size(), v.profile.size());
    for (std::size_t k = 1; k < v.path.size(); ++k) {
      const auto begin = found.part.steps.begin() + found.part.first[v.path[k - 1]],
                 end = found.part.steps.begin() + found.part.first[v.path[k - 1] + 1];
      EXPECT_NE(std::find_if(begin, end, [&](const PartGraph::Step& step) { return step.to == v.path[k]; }), end);
    }
  }
  // The notch is 9 deep, seen from a bridge that runs along or across the depth of 3.
  const double radius = bounding_sphere(test::u_shape(12, 3)).radius;
  EXPECT_GE(found.bridges.concavity, 9 / radius - 1e-9);
  EXPECT_LE(found.bridges.concavity, std::hypot(9, 3) / radius + 1e-9);
}

}  // namespace
}  // namespace partwise
