#include "partwise/geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "partwise/geometry/disjoint_sets.h"

namespace partwise {
namespace {

bool is_degenerate(const Mesh& mesh, Eigen::Index face) {
  const auto f = mesh.faces.row(face);
  return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
}

// Sets are named by their least member, so that numbering the names in ascending order is numbering by first member.
Components components(DisjointSets& sets, std::size_t count) {
  Components result;
  result.label.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int name = sets.find(static_cast<int>(i));
    result.label[i] = name == static_cast<int>(i) ? result.count++ : result.label[name];
  }
  return result;
}

// How often an edge is passed from low to high, less how often the other way.
int imbalance(std::span<const HalfEdge> edge) {
  int sum = 0;
  for (const HalfEdge& h : edge) sum += h.forward ? 1 : -1;
  return sum;
}

// For each face the neighbours across edges with exactly two faces, -1 where there is none, by corner; and whether the
// two run the same way along the edge, which neighbours that agree do not.
struct ManifoldNeighbours {
  std::vector<std::array<int, 3>> face;
  std::vector<std::array<bool, 3>> disagrees;
};

ManifoldNeighbours manifold_neighbours(const std::vector<HalfEdge>& sorted, std::size_t faces) {
  ManifoldNeighbours result;
  result.face.assign(faces, {-1, -1, -1});
  result.disagrees.assign(faces, {});
  for_each_edge(sorted, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    for (int side = 0; side < 2; ++side) {
      const HalfEdge &own = edge[side], &other = edge[1 - side];
      result.face[own.face][own.corner] = other.face;
      result.disagrees[own.face][own.corner] = own.forward == other.forward;
    }
  });
  return result;
}

void turn(Mesh& mesh, Eigen::Index face) { std::swap(mesh.faces(face, 1), mesh.faces(face, 2)); }

double area(const Mesh& mesh, int face) {
  const Point a = mesh.vertices.row(mesh.faces(face, 0)), b = mesh.vertices.row(mesh.faces(face, 1)),
              c = mesh.vertices.row(mesh.faces(face, 2));
  return (b - a).cross(c - a).norm() / 2;
}

// Turns the smaller side of every patch whose neighbours disagree.
void make_neighbours_agree(Mesh& mesh, const std::vector<HalfEdge>& sorted) {
  const auto faces = static_cast<std::size_t>(mesh.faces.rows());
  const ManifoldNeighbours neighbours = manifold_neighbours(sorted, faces);
  enum : char { unseen, kept, turned };
  std::vector<char> state(faces, unseen);
  std::vector<int> patch;
  for (std::size_t seed = 0; seed < faces; ++seed) {
    if (state[seed] != unseen) continue;
    state[seed] = kept;
    patch.assign(1, static_cast<int>(seed));
    bool orientable = true;
    double turned_area = 0, kept_area = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const int face = patch[i];
      (state[face] == turned ? turned_area : kept_area) += area(mesh, face);
      for (int k = 0; k < 3; ++k) {
        const int other = neighbours.face[face][k];
        if (other < 0) continue;
        const char wanted = (state[face] == turned) != neighbours.disagrees[face][k] ? turned : kept;
        if (state[other] == unseen) {
          state[other] = wanted;
          patch.push_back(other);
        } else {
          orientable &= state[other] == wanted;
        }
      }
    }
    if (!orientable) continue;
    const char smaller = turned_area <= kept_area ? turned : kept;
    const bool consistent = std::none_of(patch.begin(), patch.end(), [&](int f) { return state[f] == turned; });
    if (consistent) continue;
    for (const int face : patch)
      if (state[face] == smaller) turn(mesh, face);
  }
}

// Turns the closed pieces inside out if their volume is negative in all.
void make_volume_positive(Mesh& mesh) {
  const std::vector<HalfEdge> sorted = sorted_half_edges(mesh);
  DisjointSets sets(static_cast<std::size_t>(mesh.faces.rows()));
  for_each_edge(sorted, [&](std::span<const HalfEdge> edge) {
    for (const HalfEdge& h : edge) sets.join(h.face, edge[0].face);
  });
  const Components pieces = components(sets, static_cast<std::size_t>(mesh.faces.rows()));
  std::vector<char> closed(static_cast<std::size_t>(pieces.count), 1);
  for_each_edge(sorted, [&](std::span<const HalfEdge> edge) {
    if (imbalance(edge) != 0) closed[pieces.label[edge[0].face]] = 0;
  });
  std::vector<Eigen::Index> of_closed;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    if (closed[pieces.label[f]] && !is_degenerate(mesh, f)) of_closed.push_back(f);
  const Mesh solid{mesh.vertices, mesh.faces(of_closed, Eigen::all)};
  if (signed_volume(solid) >= 0) return;
  for (const Eigen::Index f : of_closed) turn(mesh, f);
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  // Counting sort by the lower vertex, then a comparison sort of the few about each vertex.
  std::vector<std::size_t> first(static_cast<std::size_t>(mesh.vertices.rows()) + 1, 0);
  const auto visit = [&](const auto& emit) {
    for (int face = 0; face < mesh.faces.rows(); ++face) {
      if (is_degenerate(mesh, face)) continue;
      for (int k = 0; k < 3; ++k) {
        const int from = mesh.faces(face, k), to = mesh.faces(face, (k + 1) % 3);
        emit(HalfEdge{std::min(from, to), std::max(from, to), face, k, from < to});
      }
    }
  };
  visit([&](const HalfEdge& h) { ++first[h.low + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<HalfEdge> sorted(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  visit([&](const HalfEdge& h) { sorted[next[h.low]++] = h; });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(first[v + 1]), [](const HalfEdge& a, const HalfEdge& b) {
                return std::tie(a.high, a.face, a.corner) < std::tie(b.high, b.face, b.corner);
              });
  }
  return sorted;
}

bool is_watertight(const Mesh& mesh) {
  const std::vector<HalfEdge> sorted = sorted_half_edges(mesh);
  bool balanced = !sorted.empty();
  for_each_edge(sorted, [&](std::span<const HalfEdge> edge) { balanced &= imbalance(edge) == 0; });
  return balanced;
}

FaceAdjacency face_adjacency(const Mesh& mesh) {
  const std::vector<HalfEdge> sorted = sorted_half_edges(mesh);
  const auto faces = static_cast<std::size_t>(mesh.faces.rows());
  // Both directions of every link between faces that stand one after the other at an edge.
  const auto visit = [&](const auto& emit) {
    for_each_edge(sorted, [&](std::span<const HalfEdge> edge) {
      for (std::size_t i = 1; i < edge.size(); ++i) {
        emit(edge[i - 1].face, edge[i].face);
        emit(edge[i].face, edge[i - 1].face);
      }
    });
  };
  std::vector<int> start(faces + 1, 0);
  visit([&](int face, int) { ++start[face + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> links(static_cast<std::size_t>(start.back()));
  std::vector<int> next(start.begin(), start.end() - 1);
  visit([&](int face, int other) { links[next[face]++] = other; });

  FaceAdjacency adjacency;
  adjacency.first.reserve(faces + 1);
  adjacency.neighbours.reserve(links.size());
  for (std::size_t f = 0; f < faces; ++f) {
    adjacency.first.push_back(static_cast<int>(adjacency.neighbours.size()));
    const auto begin = links.begin() + start[f], end = links.begin() + start[f + 1];
    std::sort(begin, end);
    adjacency.neighbours.insert(adjacency.neighbours.end(), begin, std::unique(begin, end));
  }
  adjacency.first.push_back(static_cast<int>(adjacency.neighbours.size()));
  return adjacency;
}

Components vertex_components(const Mesh& mesh) {
  DisjointSets sets(static_cast<std::size_t>(mesh.vertices.rows()));
  for (const auto& f : mesh.faces.rowwise()) {
    sets.join(f[0], f[1]);
    sets.join(f[0], f[2]);
  }
  return components(sets, static_cast<std::size_t>(mesh.vertices.rows()));
}

Components face_components_by_vertex(const Mesh& mesh) {
  const Components vertices = vertex_components(mesh);
  std::vector<int> number(static_cast<std::size_t>(vertices.count), -1);  // of the component of faces
  Components faces;
  faces.label.reserve(static_cast<std::size_t>(mesh.faces.rows()));
  for (const auto& f : mesh.faces.rowwise()) {
    int& own = number[vertices.label[f[0]]];
    if (own < 0) own = faces.count++;
    faces.label.push_back(own);
  }
  return faces;
}

Mesh orient_consistently(const Mesh& mesh) {
  Mesh oriented = mesh;
  make_neighbours_agree(oriented, sorted_half_edges(mesh));
  make_volume_positive(oriented);
  return oriented;
}

}  // namespace partwise
