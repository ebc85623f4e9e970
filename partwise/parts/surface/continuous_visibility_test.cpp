#include "partwise/parts/surface/continuous_visibility.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "partwise/base/error.h"
#include "partwise/geometry/inner_visibility.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/surface/surface_graph.h"
#include "partwise/parts/surface/test_surfaces.h"
#include "partwise/parts/surface/visible_region.h"

namespace partwise {
namespace {

double area(const Mesh& mesh) {
  const std::vector<double> areas = face_areas(mesh);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

Mesh fine_box(const Point& low, const Point& high, double edge) {
  return split_long_edges(test::box(low, high), edge, 100000).mesh;
}

// A surface of revolution about z: the profile's points (radius, z) from the lower pole to the upper, both on the axis.
Mesh revolved(const std::vector<Eigen::Vector2d>& profile, int around) {
  const int rings = static_cast<int>(profile.size()) - 2;
  Mesh mesh{Vertices(rings * around + 2, 3), Faces(2 * rings * around, 3)};
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      mesh.vertices.row(r * around + k) << profile[r + 1][0] * std::cos(angle), profile[r + 1][0] * std::sin(angle),
          profile[r + 1][1];
    }
  const int low = rings * around, high = low + 1;
  mesh.vertices.row(low) << 0, 0, profile.front()[1];
  mesh.vertices.row(high) << 0, 0, profile.back()[1];
  int f = 0;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    mesh.faces.row(f++) << low, next, k;
    mesh.faces.row(f++) << high, (rings - 1) * around + k, (rings - 1) * around + next;
    for (int r = 0; r + 1 < rings; ++r) {
      const int a = r * around + k, b = r * around + next;
      mesh.faces.row(f++) << a, b, b + around;
      mesh.faces.row(f++) << a, b + around, a + around;
    }
  }
  return mesh;
}

Mesh wavy(int rings, int around) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= rings + 1; ++i) {
    const double t = static_cast<double>(i) / (rings + 1), z = 4 * t - 2;
    profile.emplace_back(std::sqrt(std::max(0.0, t * (1 - t))) * (1 + 0.45 * std::sin(14 * t)), z);
  }
  return revolved(profile, around);
}

Mesh cup(int steps, int around) {
  std::vector<Eigen::Vector2d> profile;
  const auto line = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    for (int i = 0; i < steps; ++i) profile.push_back(a + (b - a) * i / steps);
  };
  line({0, 0}, {1, 0});
  line({1, 0}, {1, 2});
  line({1, 2}, {0.8, 2});
  line({0.8, 2}, {0.8, 0.2});
  line({0.8, 0.2}, {0, 0.2});
  profile.emplace_back(0, 0.2);
  return revolved(profile, around);
}

std::vector<Mesh> shapes() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  Mesh rough = fine_box({0, 0, 0}, {2, 1, 1}, 0.25);
  for (double& x : rough.vertices.reshaped()) x += noise(random);
  Mesh open = wavy(24, 20);
  open.faces = Faces(open.faces.topRows(open.faces.rows() * 2 / 3));
  Mesh two = wavy(16, 12);
  const Mesh second = fine_box({1.2, 0, 0}, {2, 1, 1}, 0.4);
  Mesh both{Vertices(two.vertices.rows() + second.vertices.rows(), 3),
            Faces(two.faces.rows() + second.faces.rows(), 3)};
  both.vertices << two.vertices, second.vertices;
  both.faces << two.faces, (second.faces.array() + static_cast<int>(two.vertices.rows())).matrix();
  return {wavy(40, 30), cup(8, 24), rough, open, both};
}

TEST(ContinuousVisibility, OfAConvexSolidIsItsWholeArea) {
  for (const Mesh& mesh : {fine_box({0, 0, 0}, {3, 2, 1}, 0.5), test::box({-1, -1, -1}, {1, 1, 1})}) {
    for (const auto kind : {VisibilityKind::cvf, VisibilityKind::avg, VisibilityKind::strong, VisibilityKind::weak}) {
      for (const auto method : {VisibilityMethod::filter, VisibilityMethod::bfs, VisibilityMethod::bfs_plain}) {
        const VisibilityFeature feature = continuous_visibility(mesh, {.kind = kind, .method = method});
        for (const double value : feature.values) EXPECT_NEAR(value / area(mesh), 1, 1e-12);
      }
    }
  }
}

TEST(ContinuousVisibility, FilterGivesTheRegionOfTheSearchWithFewerTests) {
  for (const Mesh& mesh : shapes()) {
    const SurfaceGraph graph = surface_graph(mesh);
    const InnerVisibility visibility(graph.mesh);
    VisibleRegion filter(graph, visibility), search(graph, visibility);
    std::vector<std::pair<int, int>> hints;
    for (int v = 0; v < graph.size(); ++v) {
      filter.find(v, VisibilityMethod::filter, v % 5 ? &hints : nullptr);  // Hints may be wrong, or missing.
      hints = filter.edge_pairs();
      search.find(v, VisibilityMethod::bfs);
      for (int w = 0; w < graph.size(); ++w) ASSERT_EQ(filter.contains(w), search.contains(w)) << v << " " << w;
      EXPECT_EQ(filter.vertices().size(), search.vertices().size());
    }
    EXPECT_LT(filter.tests(), search.tests());
  }
}

// Whether some face at v has the eye on its inner side or, to rounding, in its plane.
bool positive(const SurfaceGraph& graph, int eye, int v) {
  for (const int f : graph.faces(v)) {
    const Point a = graph.mesh.vertices.row(graph.mesh.faces(f, 0));
    const Point across = (graph.mesh.vertices.row(graph.mesh.faces(f, 1)) - a)
                             .cross(graph.mesh.vertices.row(graph.mesh.faces(f, 2)) - a);
    if (across.dot(graph.mesh.vertices.row(eye) - a) <= 1e-6 * across.norm()) return true;
  }
  return false;
}

// All vertices that chains of allowed ones join to `start`, by going over all edges until nothing changes.
std::vector<char> joined(const SurfaceGraph& graph, int start, const std::vector<char>& allowed) {
  std::vector<char> reached(static_cast<std::size_t>(graph.size()), 0);
  reached[start] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    for (int a = 0; a < graph.size(); ++a)
      for (const int b : graph.neighbours(a))
        if (reached[a] && !reached[b] && allowed[b]) reached[b] = 1, changed = true;
  }
  return reached;
}

// It errs where a path to the end of the positive region meets an island, which on these shapes is seldom or never.
TEST(ContinuousVisibility, PublishedFilterAgreesOnMostViewpoints) {
  for (const Mesh& mesh : {wavy(40, 30), cup(8, 24), test::dumbbell(40, 20)}) {
    const VisibilityVectors expected = visibility_vectors(mesh, VisibilityMethod::bfs);
    const VisibilityVectors found = visibility_vectors(mesh, VisibilityMethod::filter_printed);
    int same = 0;
    for (int v = 0; v < expected.sees.size(); ++v) same += found.sees.row(v) == expected.sees.row(v);
    EXPECT_GE(same, 0.75 * expected.sees.size());
    EXPECT_LT(found.tests, expected.tests);
  }
}

// By the definitions, in the plainest way.
TEST(ContinuousVisibility, SearchFindsWhatTheDefinitionSays) {
  int islands = 0;
  for (const Mesh& mesh : {wavy(14, 10), cup(4, 10), shapes()[2]}) {
    const SurfaceGraph graph = surface_graph(mesh);
    const InnerVisibility visibility(graph.mesh);
    VisibleRegion region(graph, visibility);
    std::vector<char> seen(static_cast<std::size_t>(graph.size())), faced(seen), other(seen);
    for (int v = 0; v < graph.size(); ++v) {
      for (int w = 0; w < graph.size(); ++w) {
        seen[w] = w == v || visibility.sees(v, w);
        faced[w] = w == v || (seen[w] && positive(graph, v, w));
      }
      const std::vector<char> plain = joined(graph, v, seen);
      region.find(v, VisibilityMethod::bfs_plain);
      for (int w = 0; w < graph.size(); ++w) ASSERT_EQ(region.contains(w), plain[w] != 0);

      const std::vector<char> reached = joined(graph, v, faced);
      for (int w = 0; w < graph.size(); ++w) other[w] = !reached[w];
      region.find(v, VisibilityMethod::bfs);
      for (int w = 0; w < graph.size(); ++w) {
        bool island = !reached[w];
        if (island) {
          const std::vector<char> piece = joined(graph, w, other);
          for (int u = 0; u < graph.size(); ++u) island = island && (!piece[u] || positive(graph, v, u));
        }
        islands += island;
        ASSERT_EQ(region.contains(w), reached[w] || island) << v << " " << w;
      }
    }
  }
  EXPECT_GT(islands, 0);
}

TEST(ContinuousVisibility, InsideOfACupSeesLessThanItsOutside) {
  const Mesh mesh = cup(10, 30);
  const VisibilityFeature plain = continuous_visibility(mesh);
  const VisibilityFeature mean = continuous_visibility(mesh, {.kind = VisibilityKind::avg});
  double inside = 0, outside = 0, mean_inside = 0, mean_outside = 0;
  int count_inside = 0, count_outside = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const double r = mesh.vertices.row(v).head<2>().norm(), z = mesh.vertices(v, 2);
    if (z < 0.5 || z > 1.7) continue;
    if (r < 0.9) inside += plain.values[v], mean_inside += mean.values[v], ++count_inside;
    if (r > 0.9) outside += plain.values[v], mean_outside += mean.values[v], ++count_outside;
  }
  EXPECT_LT(inside / count_inside, 0.6 * outside / count_outside);
  EXPECT_NEAR(mean_inside / count_inside, mean_outside / count_outside, 0.1 * mean_outside / count_outside);
}

TEST(ContinuousVisibility, StrongAndWeakAreWhatTheVectorsSay) {
  const Mesh mesh = wavy(20, 16);
  const VisibilityVectors vectors = visibility_vectors(mesh);
  const VisibilityFeature cvf = continuous_visibility(mesh),
                          strong = continuous_visibility(mesh, {.kind = VisibilityKind::strong});
  const SurfaceGraph graph = surface_graph(mesh);
  bool some_one_way = false;
  for (Eigen::Index p = 0; p < mesh.vertices.rows(); ++p) {
    const int row = vectors.of_vertex[p];
    std::int64_t one_way = 0, both_ways = 0;
    for (int q = 0; q < vectors.sees.size(); ++q) {
      if (!vectors.sees.contains(row, q)) continue;
      one_way += graph.weight[q];
      both_ways += vectors.sees.contains(q, row) ? graph.weight[q] : 0;
    }
    EXPECT_EQ(cvf.values[p], graph.area_of(one_way));
    EXPECT_EQ(strong.values[p], graph.area_of(both_ways));
    some_one_way = some_one_way || one_way != both_ways;
  }
  EXPECT_TRUE(some_one_way);
  // A wider threshold lets more through, and never more than all.
  double before = 0;
  for (const double threshold : {0.01, 0.1, 0.5, 5.0}) {
    const double sum =
        continuous_visibility(mesh, {.kind = VisibilityKind::weak, .weak_threshold = threshold}).values.sum();
    EXPECT_GE(sum, before);
    before = sum;
  }
}

TEST(ContinuousVisibility, IsTheSameForAnyThreadsAndScalesWithTheMesh) {
  const Mesh mesh = wavy(30, 20);
  const VisibilityFeature all = continuous_visibility(mesh);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const VisibilityFeature alone = continuous_visibility(mesh);
  EXPECT_EQ(all.values, alone.values);
  EXPECT_EQ(all.tests, alone.tests);
  const VisibilityFeature larger = continuous_visibility({mesh.vertices * 8, mesh.faces});
  EXPECT_TRUE(larger.values.isApprox(64 * all.values, 1e-12));
}

TEST(ContinuousVisibility, VerticesAtOnePlaceAreOneAndThoseWithoutAFaceHaveNothing) {
  const Mesh mesh = wavy(12, 10);
  const VisibilityFeature whole = continuous_visibility(mesh);
  Mesh split{Vertices(mesh.faces.size() + 1, 3), Faces(mesh.faces.rows(), 3)};
  split.vertices.row(mesh.faces.size()) << 9, 9, 9;
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    split.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    split.faces.data()[i] = static_cast<int>(i);
  }
  const VisibilityFeature parts = continuous_visibility(split);
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) EXPECT_EQ(parts.values[i], whole.values[mesh.faces.data()[i]]);
  EXPECT_EQ(parts.values[mesh.faces.size()], 0);
}

TEST(ContinuousVisibility, DegenerateFacesChangeNothing) {
  Mesh mesh = wavy(12, 10);
  const VisibilityFeature before = continuous_visibility(mesh);
  mesh.faces.conservativeResize(mesh.faces.rows() + 2, 3);
  mesh.faces.bottomRows(2) << 5, 5, 6, 7, 7, 7;
  const VisibilityFeature after = continuous_visibility(mesh);
  EXPECT_TRUE(after.values.isApprox(before.values, 1e-12));
}

TEST(ContinuousVisibility, OfFacesIsTheMeanOfTheirCorners) {
  const Mesh mesh{Vertices::Zero(4, 3), (Faces(2, 3) << 0, 1, 2, 3, 2, 1).finished()};
  EXPECT_EQ(face_means(mesh, Eigen::Vector4d(3, 6, 9, 12)), Eigen::Vector2d(6, 9));
}

TEST(ContinuousVisibility, RefusesWhatItCannotUse) {
  EXPECT_THROW(continuous_visibility({Vertices::Zero(3, 3), (Faces(1, 3) << 0, 1, 2).finished()}), InputError);
  EXPECT_THROW(continuous_visibility(wavy(5, 5), {.weak_threshold = 0}), InputError);
}

TEST(VisibilityMatrix, HoldsWhatItIsGiven) {
  std::mt19937 random(4);
  constexpr int kSize = 5000;  // more than one block, runs of all lengths
  VisibilityMatrix matrix(kSize);
  std::vector<std::vector<int>> rows(kSize);
  for (int r = 0; r < kSize; r += 1 + static_cast<int>(random() % 40)) {
    for (int c = static_cast<int>(random() % 700); c < kSize; c += static_cast<int>(random() % 900) + 1)
      for (int run = static_cast<int>(random() % 300); run > 0 && c < kSize; --run) rows[r].push_back(c++);
    matrix.set_row(r, rows[r]);
  }
  const VisibilityMatrix mutual = matrix.mutual();
  for (int r = 0; r < kSize; ++r) {
    ASSERT_EQ(matrix.row(r), rows[r]);
    std::vector<int> both;
    for (const int c : rows[r])
      if (std::binary_search(rows[c].begin(), rows[c].end(), r)) both.push_back(c);
    ASSERT_EQ(mutual.row(r), both);
  }
}

}  // namespace
}  // namespace partwise
