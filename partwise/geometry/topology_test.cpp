#include "partwise/geometry/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

Mesh make(std::vector<std::array<double, 3>> vertices, std::vector<std::array<int, 3>> faces) {
  Mesh mesh{Vertices(static_cast<Eigen::Index>(vertices.size()), 3), Faces(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t i = 0; i < vertices.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = Point(vertices[i].data());
  for (std::size_t i = 0; i < faces.size(); ++i)
    mesh.faces.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3i(faces[i].data());
  return mesh;
}

Mesh tetrahedron() {
  return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
}

// A torus of n x m quadrangles cut in two, radii 2 and 1, counter-clockwise from outside.
Mesh torus(int n, int m) {
  Mesh mesh{Vertices(n * m, 3), Faces(2 * n * m, 3)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      mesh.vertices.row(i * m + j) << (2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v);
      const int a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      mesh.faces.row(2 * a) << a, b, c;
      mesh.faces.row(2 * a + 1) << a, c, d;
    }
  return mesh;
}

Mesh join(const Mesh& a, const Mesh& b) {
  Mesh both{Vertices(a.vertices.rows() + b.vertices.rows(), 3), Faces(a.faces.rows() + b.faces.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.faces << a.faces, b.faces.array() + static_cast<int>(a.vertices.rows());
  return both;
}

Mesh reversed(Mesh mesh) {
  mesh.faces.col(1).swap(mesh.faces.col(2));
  return mesh;
}

// Few vertices and many faces, so that edges have up to a dozen faces and many faces are degenerate or repeated.
Mesh random_mesh(std::mt19937& random, int vertices, int faces) {
  std::uniform_int_distribution<int> vertex(0, vertices - 1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Mesh mesh{Vertices(vertices, 3), Faces(faces, 3)};
  for (double& x : mesh.vertices.reshaped()) x = coordinate(random);
  for (int& v : mesh.faces.reshaped()) v = vertex(random);
  return mesh;
}

bool is_degenerate(const Mesh& mesh, int f) {
  const auto row = mesh.faces.row(f);
  return row[0] == row[1] || row[1] == row[2] || row[2] == row[0];
}

// By definition: for each edge its faces, ascending, and the sum of their directions.
struct Edge {
  std::vector<int> faces;
  int sum = 0;
};
std::map<std::pair<int, int>, Edge> edges_of(const Mesh& mesh) {
  std::map<std::pair<int, int>, Edge> edges;
  for (int f = 0; f < mesh.faces.rows(); ++f) {
    if (is_degenerate(mesh, f)) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
      Edge& edge = edges[std::minmax(a, b)];
      edge.faces.push_back(f);
      edge.sum += a < b ? 1 : -1;
    }
  }
  return edges;
}

// Components by repeated painting.
template <typename Connected>
Components painted(int size, const Connected& connected) {
  Components result;
  result.label.assign(size, -1);
  for (int seed = 0; seed < size; ++seed) {
    if (result.label[seed] >= 0) continue;
    result.label[seed] = result.count;
    for (bool changed = true; changed;) {
      changed = false;
      for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b)
          if (result.label[a] == result.count && result.label[b] < 0 && connected(a, b)) {
            result.label[b] = result.count;
            changed = true;
          }
    }
    ++result.count;
  }
  return result;
}

TEST(Topology, AgreesWithBruteForceOnRandomMeshes) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const Mesh mesh = random_mesh(random, 4 + trial % 20, trial % 25);
    const auto edges = edges_of(mesh);

    const std::vector<HalfEdge> sorted = sorted_half_edges(mesh);
    auto expected = edges.begin();
    for_each_edge(sorted, [&](std::span<const HalfEdge> edge) {
      ASSERT_NE(expected, edges.end());
      EXPECT_EQ(std::pair(edge[0].low, edge[0].high), expected->first);
      ASSERT_EQ(edge.size(), expected->second.faces.size());
      for (std::size_t i = 0; i < edge.size(); ++i) {
        EXPECT_EQ(edge[i].face, expected->second.faces[i]);
        EXPECT_EQ(mesh.faces(edge[i].face, edge[i].corner), edge[i].forward ? edge[i].low : edge[i].high);
      }
      ++expected;
    });
    EXPECT_EQ(expected, edges.end());

    const bool balanced = std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second.sum == 0; });
    EXPECT_EQ(is_watertight(mesh), balanced && !edges.empty());

    std::vector<std::set<int>> neighbours(static_cast<std::size_t>(mesh.faces.rows()));
    for (const auto& [ends, edge] : edges)
      for (std::size_t i = 1; i < edge.faces.size(); ++i) {
        neighbours[edge.faces[i]].insert(edge.faces[i - 1]);
        neighbours[edge.faces[i - 1]].insert(edge.faces[i]);
      }
    const FaceAdjacency adjacency = face_adjacency(mesh);
    for (int f = 0; f < mesh.faces.rows(); ++f) EXPECT_THAT(adjacency.of(f), ElementsAreArray(neighbours[f]));

    const auto names = [&](int f, int v) { return (mesh.faces.row(f).array() == v).any(); };
    const Components by_vertex = painted(static_cast<int>(mesh.faces.rows()), [&](int f, int g) {
      return names(g, mesh.faces(f, 0)) || names(g, mesh.faces(f, 1)) || names(g, mesh.faces(f, 2));
    });
    const Components faces = face_components_by_vertex(mesh);
    EXPECT_EQ(faces.count, by_vertex.count);
    EXPECT_EQ(faces.label, by_vertex.label);

    const Components of_vertices = painted(static_cast<int>(mesh.vertices.rows()), [&](int a, int b) {
      for (int f = 0; f < mesh.faces.rows(); ++f)
        if (names(f, a) && names(f, b)) return true;
      return false;
    });
    const Components vertices = vertex_components(mesh);
    EXPECT_EQ(vertices.count, of_vertices.count);
    EXPECT_EQ(vertices.label, of_vertices.label);
  }
}

TEST(Topology, WatertightOnes) {
  EXPECT_TRUE(is_watertight(tetrahedron()));
  EXPECT_TRUE(is_watertight(reversed(tetrahedron())));
  EXPECT_TRUE(is_watertight(torus(7, 5)));
  Mesh mesh = tetrahedron();
  mesh.faces.conservativeResize(5, 3);
  mesh.faces.row(4) << 2, 2, 0;
  EXPECT_TRUE(is_watertight(mesh));  // A degenerate face bounds nothing.
  mesh.faces.row(4) << 0, 2, 1;
  EXPECT_FALSE(is_watertight(mesh));  // A face too many.
  EXPECT_FALSE(is_watertight(make({{0, 0, 0}}, {{0, 0, 0}})));
  EXPECT_FALSE(is_watertight(Mesh{Vertices(0, 3), Faces(0, 3)}));
  // Two tetrahedra that share an edge: four faces there, two each way.
  const Mesh shared = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 3, 4}, {0, 4, 5}, {3, 5, 4}, {0, 5, 3}});
  EXPECT_TRUE(is_watertight(shared));
}

TEST(Topology, OrientLeavesConsistentMeshesAlone) {
  for (const Mesh& mesh : {tetrahedron(), torus(9, 6), join(torus(8, 8), tetrahedron())})
    EXPECT_EQ(orient_consistently(mesh).faces, mesh.faces);
  // A cavity is negative by itself; the whole is positive and stays.
  Mesh large = torus(8, 8);
  large.vertices *= 3;
  const Mesh hollow = join(large, reversed(torus(8, 8)));
  EXPECT_EQ(orient_consistently(hollow).faces, hollow.faces);
  // An open mesh has no inside.
  Mesh open = reversed(torus(8, 8));
  open.faces.conservativeResize(open.faces.rows() - 3, 3);
  EXPECT_EQ(orient_consistently(open).faces, open.faces);
}

TEST(Topology, OrientRepairsTurnedFaces) {
  std::mt19937 random(2);
  std::bernoulli_distribution turned(0.3);
  const Mesh whole = join(torus(12, 7), join(tetrahedron(), torus(5, 5)));
  for (int trial = 0; trial < 20; ++trial) {
    Mesh mesh = whole;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
      if (turned(random)) std::swap(mesh.faces(f, 1), mesh.faces(f, 2));
    const Mesh oriented = orient_consistently(mesh);
    EXPECT_TRUE(is_watertight(oriented));
    EXPECT_GT(signed_volume(oriented), 0);
  }
  Mesh mesh = whole;  // With few of them turned, the result is what it was before.
  std::swap(mesh.faces(0, 1), mesh.faces(0, 2));
  std::swap(mesh.faces(30, 1), mesh.faces(30, 2));
  EXPECT_EQ(orient_consistently(mesh).faces, whole.faces);
  EXPECT_EQ(orient_consistently(reversed(whole)).faces, whole.faces);
}

TEST(Topology, OrientTurnsTheClosedPartEvenBesideAnOpenSheet) {
  const Mesh sheet = make({{9, 0, 0}, {9, 1, 0}, {9, 0, 1}}, {{0, 1, 2}});
  const Mesh oriented = orient_consistently(join(sheet, reversed(tetrahedron())));
  EXPECT_EQ(oriented.faces, join(sheet, tetrahedron()).faces);
}

TEST(Topology, OrientLeavesAMoebiusBandAlone) {
  // A strip of seven triangles, every second one turned so that all agree, but for the last with the first.
  Mesh band{Vertices(7, 3), Faces(7, 3)};
  for (int i = 0; i < 7; ++i) {
    band.vertices.row(i) << std::cos(0.9 * i), std::sin(0.9 * i), i % 2;
    band.faces.row(i) << i, (i + 1 + i % 2) % 7, (i + 2 - i % 2) % 7;
  }
  const auto edges = edges_of(band);
  const auto disagreements = std::count_if(
      edges.begin(), edges.end(), [](const auto& e) { return e.second.faces.size() == 2 && e.second.sum != 0; });
  ASSERT_GT(disagreements, 0);
  EXPECT_EQ(orient_consistently(band).faces, band.faces);
}

TEST(Weld, EqualPositionsBecomeOne) {
  const Mesh mesh = make({{1, 2, 3}, {0.0, 0, 0}, {1, 2, 3}, {-0.0, 0, -0.0}, {std::nextafter(1.0, 2), 2, 3}},
                         {{0, 1, 4}, {2, 3, 4}, {0, 2, 4}});
  const Mesh welded = weld(mesh);
  EXPECT_EQ(welded.vertices, mesh.vertices({0, 1, 4}, Eigen::all));
  Faces faces(3, 3);
  faces << 0, 1, 2, 0, 1, 2, 0, 0, 2;
  EXPECT_EQ(welded.faces, faces);
  EXPECT_EQ(weld(mesh, 1e-20).vertices.rows(), 3);
}

TEST(Weld, OfASoupIsTheMesh) {
  const Mesh mesh = torus(20, 12);
  Mesh soup{Vertices(3 * mesh.faces.rows(), 3), Faces(mesh.faces.rows(), 3)};
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    soup.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    soup.faces.data()[i] = static_cast<int>(i);
  }
  EXPECT_FALSE(is_watertight(soup));
  const Mesh welded = weld(soup);
  EXPECT_EQ(welded.vertices.rows(), mesh.vertices.rows());
  EXPECT_TRUE(is_watertight(welded));
  EXPECT_DOUBLE_EQ(signed_volume(welded), signed_volume(mesh));
}

TEST(Weld, WithToleranceAgreesWithBruteForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> tolerances(0.01, 0.8);
  for (int trial = 0; trial < 100; ++trial) {
    const Mesh mesh = random_mesh(random, 60, 20);
    const double tolerance = tolerances(random);
    std::vector<int> kept, target;
    for (int i = 0; i < 60; ++i) {
      const auto near = std::find_if(kept.begin(), kept.end(), [&](int k) {
        return (mesh.vertices.row(k) - mesh.vertices.row(i)).norm() <= tolerance;
      });
      target.push_back(static_cast<int>(near - kept.begin()));
      if (near == kept.end()) kept.push_back(i);
    }
    const Mesh welded = weld(mesh, tolerance);
    EXPECT_EQ(welded.vertices, mesh.vertices(kept, Eigen::all));
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
      EXPECT_EQ(welded.faces.data()[i], target[mesh.faces.data()[i]]);
  }
  EXPECT_THROW(weld(tetrahedron(), -1), InputError);
  EXPECT_THROW(weld(tetrahedron(), std::nan("")), InputError);
}

}  // namespace
}  // namespace partwise
