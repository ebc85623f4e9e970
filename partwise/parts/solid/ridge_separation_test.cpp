#include "partwise/parts/solid/ridge_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

PartGraph graph_of(const Mesh& mesh) { return part_graph(mesh, test::all_faces(mesh)); }

double cut_cost(const PartGraph& part, const std::vector<double>& costs, const std::vector<char>& ignore,
                const std::vector<int>& side) {
  double sum = 0;
  for (std::size_t i = 0; i < part.shared.size(); ++i) {
    const auto& e = part.shared[i];
    if (!ignore[e.face] && !ignore[e.other] && side[e.face] != side[e.other]) sum += costs[i];
  }
  return sum;
}

TEST(MinimalCut, CostsAsLittleAsTheBestOfAllCuts) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.1, 2);
  for (int round = 0; round < 60; ++round) {
    const Mesh mesh =
        round % 2 ? test::sheet(3, 2) : convex_hull(test::cloud(test::Cloud::sphere, 10, random), 1e-9).mesh;
    const PartGraph part = graph_of(mesh);
    const std::size_t faces = part.faces.size();
    std::vector<double> costs(part.shared.size());
    for (double& c : costs) c = unit(random);
    std::vector<char> ignore(faces, 0);
    std::vector<int> asked(faces, 0), free;
    for (std::size_t f = 0; f < faces; ++f) {
      const auto draw = random() % 8;
      if (draw == 0) ignore[f] = 1;
      if (draw == 1 || f == 0) asked[f] = 1;
      if (draw == 2 || f == 1) asked[f] = -1;
    }
    for (std::size_t f = 0; f < faces; ++f) {
      if (ignore[f] || asked[f] != 0) continue;
      if (free.size() < 12)
        free.push_back(static_cast<int>(f));
      else
        asked[f] = f % 2 ? 1 : -1;
    }
    double least = 1e300;
    for (unsigned bits = 0; bits < 1u << free.size(); ++bits) {
      std::vector<int> side = asked;
      for (std::size_t i = 0; i < free.size(); ++i) side[free[i]] = bits >> i & 1 ? 1 : -1;
      least = std::min(least, cut_cost(part, costs, ignore, side));
    }
    std::vector<int> side = asked;
    minimal_cut(part, costs, ignore, side);
    for (std::size_t f = 0; f < faces; ++f) {
      if (ignore[f]) continue;
      EXPECT_TRUE(side[f] == 1 || side[f] == -1);
      if (asked[f] != 0) {
        EXPECT_EQ(side[f], asked[f]);
      }
    }
    EXPECT_NEAR(cut_cost(part, costs, ignore, side), least, 1e-9);
  }
}

TEST(MinimalCut, WithoutAnythingOnOneSideNothingIsCut) {
  const PartGraph part = graph_of(test::sheet(3, 3));
  const std::vector<double> costs(part.shared.size(), 1.0);
  const std::vector<char> ignore(part.faces.size(), 0);
  for (int only : {1, -1, 0}) {
    std::vector<int> side(part.faces.size(), 0);
    side[5] = only;
    minimal_cut(part, costs, ignore, side);
    EXPECT_EQ(cut_cost(part, costs, ignore, side), 0);
  }
}

// (2.13): every edge of a regular tetrahedron is convex and of mean length, so each costs 0.8 + 0.2.
TEST(CutCosts, RegularTetrahedron) {
  const PartGraph part = graph_of(
      test::mesh_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}));
  const std::vector<double> costs = cut_costs(part);
  ASSERT_EQ(costs.size(), 6u);
  for (double c : costs) EXPECT_NEAR(c, 1, 1e-14);
}

// Three faces in a strip, one fold a valley of length 1, the other a ridge of length 2.
TEST(CutCosts, AValleyAndARidge) {
  const Mesh mesh =
      test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.5, -1, 1}, {2, 2, -1}}, {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}});
  const PartGraph part = graph_of(mesh);
  const std::vector<double> costs = cut_costs(part);
  ASSERT_EQ(part.shared.size(), 2u);
  const double fold = 1, ridge = std::sqrt(5.0), mean = (fold + ridge) / 2;
  for (std::size_t i = 0; i < 2; ++i) {
    const bool is_valley = std::max(part.shared[i].a, part.shared[i].b) == 1;
    EXPECT_NEAR(costs[i], is_valley ? 0.8 * 0.3 / 0.65 + 0.2 * fold / mean : 0.8 * 1 / 0.65 + 0.2 * ridge / mean,
                1e-14);
  }
}

TEST(SeparateRidges, EveryRidgeKeepsTheFacesAboutItsVertices) {
  for (const Mesh& shape : {test::l_shape(10, 3), test::u_shape(12, 3), test::dumbbell()}) {
    const Mesh mesh = test::normalised(shape);
    const SurfaceQuery surface(mesh);
    const PartGraph part = graph_of(mesh);
    const Bridges bridges = find_bridges(part, part_hull(part, 0.1), surface, 0.1);
    const ConvexRidges ridges = convex_ridges(part, bridges);
    ASSERT_GE(ridges.members.size(), 2u);
    const std::vector<int> label = separate_ridges(part, bridges, ridges, 0.1);
    ASSERT_EQ(label.size(), part.faces.size());
    std::vector<int> seen(ridges.members.size(), 0);
    for (std::size_t f = 0; f < label.size(); ++f) {
      ASSERT_GE(label[f], 0);
      ASSERT_LT(label[f], static_cast<int>(ridges.members.size()));
      seen[label[f]] = 1;
      int owner = -2;  // the one ridge that the face touches
      for (int v : part.corners[f])
        if (const int r = ridges.of_vertex[v]; r >= 0) owner = owner == -2 || owner == r ? r : -1;
      if (owner >= 0) {
        EXPECT_EQ(label[f], owner);
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), 0);
  }
}

TEST(SeparateRidges, ADumbbellIsCutThroughItsBar) {
  const Mesh mesh = test::normalised(test::dumbbell());
  const SurfaceQuery surface(mesh);
  const PartGraph part = graph_of(mesh);
  const Bridges bridges = find_bridges(part, part_hull(part, 0.1), surface, 0.1);
  const std::vector<int> label = separate_ridges(part, bridges, convex_ridges(part, bridges), 0.1);
  for (const auto& e : part.shared) {
    if (label[e.face] == label[e.other]) continue;
    EXPECT_LT(part.positions.row(e.a).head<2>().norm(), 0.45 / 3);
    EXPECT_LT(part.positions.row(e.b).head<2>().norm(), 0.45 / 3);
  }
}

}  // namespace
}  // namespace partwise
