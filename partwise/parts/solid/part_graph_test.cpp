#include "partwise/parts/solid/part_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

// All shortest lengths over the graph's links (Floyd 1962, Warshall 1962).
Eigen::MatrixXd all_lengths(const PartGraph& graph) {
  const int n = graph.size();
  Eigen::MatrixXd length = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
  for (int v = 0; v < n; ++v) {
    length(v, v) = 0;
    for (int i = graph.first[v]; i < graph.first[v + 1]; ++i)
      length(v, graph.steps[i].to) = std::min(length(v, graph.steps[i].to), graph.steps[i].length);
  }
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) length(i, j) = std::min(length(i, j), length(i, k) + length(k, j));
  return length;
}

std::vector<Mesh> meshes() {
  std::mt19937_64 random(1);
  Mesh rough = test::sheet(5, 2);
  rough.vertices += 0.3 * test::cloud(test::Cloud::box, static_cast<int>(rough.vertices.rows()), random);
  return {rough, test::l_shape(4, 1), convex_hull(test::cloud(test::Cloud::sphere, 30, random), 1e-9).mesh,
          test::joined(test::sheet(2, 2), test::moved(test::sheet(2, 1), Point(10, 0, 0)))};
}

TEST(PathSearch, EqualsAllPairsShortestPaths) {
  for (const Mesh& mesh : meshes()) {
    const PartGraph graph = part_graph(mesh, test::all_faces(mesh));
    const Eigen::MatrixXd length = all_lengths(graph);
    PathSearch search(graph);
    for (int a = 0; a < graph.size(); ++a) {
      std::vector<int> targets;
      for (int b = a % 3; b < graph.size(); b += 3) targets.push_back(b);
      search.from(a, targets);
      for (int b : targets) {
        const std::vector<int> path = search.path_to(b);
        ASSERT_EQ(path.empty(), std::isinf(length(a, b)));
        if (path.empty()) continue;
        EXPECT_EQ(path.front(), a);
        EXPECT_EQ(path.back(), b);
        double sum = 0;
        for (std::size_t k = 1; k < path.size(); ++k) sum += length(path[k - 1], path[k]);
        EXPECT_NEAR(sum, length(a, b), 1e-12);
      }
      for (int b = 0; b < graph.size(); ++b) {
        if (std::isinf(length(a, b))) {
          EXPECT_TRUE(std::isinf(search.bounded_length(a, b, 1e9)));
          EXPECT_FALSE(search.has_path(a, b, 1e9));
          continue;
        }
        EXPECT_NEAR(search.bounded_length(a, b, length(a, b) + 1e-9), length(a, b), 1e-12);
        EXPECT_NEAR(search.bounded_length(a, b, 1e9), length(a, b), 1e-12);
        EXPECT_TRUE(search.has_path(a, b, length(a, b) + 1e-9));
        if (a != b) {
          EXPECT_TRUE(std::isinf(search.bounded_length(a, b, length(a, b) - 1e-9)));
          EXPECT_FALSE(search.has_path(a, b, length(a, b) - 1e-9));
        }
      }
    }
  }
}

TEST(PathSearch, WithinReachIsTheLeastOverTheSources) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 3);
  for (const Mesh& mesh : meshes()) {
    const PartGraph graph = part_graph(mesh, test::all_faces(mesh));
    const Eigen::MatrixXd length = all_lengths(graph);
    PathSearch search(graph);
    for (int round = 0; round < 30; ++round) {
      std::vector<std::pair<int, double>> sources;
      for (int s = 0; s < round % 5; ++s)
        sources.emplace_back(static_cast<int>(random() % static_cast<unsigned>(graph.size())), unit(random));
      const std::vector<double> value = search.within_reach(sources);
      for (int v = 0; v < graph.size(); ++v) {
        double least = 0;
        for (const auto& [s, reach] : sources) least = std::min(least, length(s, v) - reach);
        EXPECT_NEAR(value[v], least, 1e-12);
      }
    }
  }
}

TEST(PartGraph, UnfoldedDiagonalsMakeBothDiagonalsOfASquareShort) {
  const Mesh mesh = test::sheet(6, 3);  // Folded along a line of the grid: still flat as far as paths go.
  const PartGraph graph = part_graph(mesh, test::all_faces(mesh));
  const Eigen::MatrixXd length = all_lengths(graph);
  const auto at = [](int x, int y) { return 7 * y + x; };
  EXPECT_NEAR(length(at(0, 0), at(6, 6)), 6 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(length(at(6, 0), at(0, 6)), 6 * std::sqrt(2.0), 1e-12);  // No edge runs this way.
  EXPECT_NEAR(length(at(0, 0), at(6, 0)), 6, 1e-12);
  EXPECT_NEAR(length(at(0, 0), at(1, 2)), std::sqrt(5.0), 1e-12);  // across two faces of neighbouring squares
  for (int v = 0; v < graph.size(); ++v)
    for (int w = 0; w < graph.size(); ++w) {
      const double dx = v % 7 - w % 7, dy = v / 7 - w / 7;
      EXPECT_GE(length(v, w), std::hypot(dx, dy) - 1e-12);         // no path is shorter than the geodesic
      EXPECT_LE(length(v, w), 1.09 * std::hypot(dx, dy) + 1e-12);  // nor much longer
    }
}

TEST(PartGraph, NoDiagonalWhereItWouldLeaveTheFaces) {
  // The two faces unfold to a quadrilateral that is not convex at (0, 0).
  const Mesh mesh = test::mesh_of({{0, 0, 0}, {3, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}});
  const PartGraph graph = part_graph(mesh, test::all_faces(mesh));
  EXPECT_NEAR(all_lengths(graph)(2, 3), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(graph.steps.size(), 10u);
}

TEST(PartGraph, LocalNumbersAndSharedEdges) {
  const Mesh mesh = test::mesh_of({{9, 9, 9}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {5, 5, 5}},
                                  {{6, 6, 6}, {1, 2, 3}, {0, 0, 6}, {2, 1, 4}, {1, 2, 5}});
  const std::vector<int> faces{1, 3, 4};
  const PartGraph graph = part_graph(mesh, faces);
  EXPECT_EQ(graph.vertices, (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(graph.faces, faces);
  ASSERT_EQ(graph.shared.size(), 2u);  // Three faces at an edge: each with the next.
  EXPECT_EQ(graph.shared[0].face, 0);
  EXPECT_EQ(graph.shared[0].other, 1);
  EXPECT_EQ(graph.shared[1].face, 1);
  EXPECT_EQ(graph.shared[1].other, 2);
  EXPECT_EQ(std::min(graph.shared[0].a, graph.shared[0].b), 0);
  EXPECT_EQ(std::max(graph.shared[0].a, graph.shared[0].b), 1);
  const PartGraph odd = part_graph(mesh, std::vector<int>{0, 2});  // Faces that name a vertex twice.
  EXPECT_EQ(odd.size(), 2);
  EXPECT_NEAR(all_lengths(odd)(0, 1), std::sqrt(48.0), 1e-12);
}

}  // namespace
}  // namespace partwise
