#include "partwise/parts/surface/surface_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "partwise/base/error.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr int kWeightBits = 62;

// The lowest 21 bits of x, two zeros after each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFu;
  x = (x | x << 16) & 0x001F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

std::uint64_t morton_code(const Point& p) {  // of a point in [-1, 1]^3
  constexpr double kCells = 1048575;
  const Eigen::Array3d cell = ((p.array() + 1) * kCells).round().transpose().max(0.0);
  return spread(static_cast<std::uint64_t>(cell[0])) | spread(static_cast<std::uint64_t>(cell[1])) << 1 |
         spread(static_cast<std::uint64_t>(cell[2])) << 2;
}

// The second members by the first one, ascending and each once.
void flatten(std::vector<std::pair<int, int>>& pairs, int count, std::vector<int>& first, std::vector<int>& list) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first.assign(static_cast<std::size_t>(count) + 1, 0);
  list.clear();
  for (const auto& [from, to] : pairs) {
    ++first[from + 1];
    list.push_back(to);
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
}

}  // namespace

double SurfaceGraph::area_of(std::int64_t weights) const {
  return std::ldexp(static_cast<double>(weights), -kWeightBits) * area;
}

SurfaceGraph surface_graph(const Mesh& input) {
  const Mesh welded = weld(input);
  const Sphere sphere = bounding_sphere(welded);
  if (!(sphere.radius > 0))
    throw InputError("mesh", "no face has an area", "give a mesh with at least one proper triangle");
  SurfaceGraph graph;
  graph.radius = sphere.radius;
  std::vector<char> used(static_cast<std::size_t>(welded.vertices.rows()), 0);
  for (int v : welded.faces.reshaped()) used[v] = 1;
  std::vector<std::pair<std::uint64_t, int>> order;
  for (int v = 0; v < static_cast<int>(used.size()); ++v)
    if (used[v]) order.emplace_back(morton_code((welded.vertices.row(v) - sphere.centre) / sphere.radius), v);
  std::sort(order.begin(), order.end());
  std::vector<int> number(used.size(), -1);
  graph.mesh.vertices.resize(static_cast<Eigen::Index>(order.size()), 3);
  for (int i = 0; i < graph.size(); ++i) {
    number[order[i].second] = i;
    graph.mesh.vertices.row(i) = (welded.vertices.row(order[i].second) - sphere.centre) / sphere.radius;
  }
  graph.mesh.faces = welded.faces.unaryExpr([&](int v) { return number[v]; });
  graph.of_input.assign(static_cast<std::size_t>(input.vertices.rows()), -1);
  for (Eigen::Index i = 0; i < input.faces.size(); ++i)
    graph.of_input[input.faces.data()[i]] = graph.mesh.faces.data()[i];

  std::vector<std::pair<int, int>> neighbours, faces;
  for (int f = 0; f < static_cast<int>(graph.mesh.faces.rows()); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = graph.mesh.faces(f, k), b = graph.mesh.faces(f, (k + 1) % 3);
      faces.emplace_back(a, f);
      if (a == b) continue;
      neighbours.emplace_back(a, b);
      neighbours.emplace_back(b, a);
    }
  }
  flatten(neighbours, graph.size(), graph.first_neighbour, graph.neighbour_list);
  flatten(faces, graph.size(), graph.first_face, graph.face_list);

  const std::vector<double> area = face_areas(graph.mesh);
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  if (!(whole > 0)) throw InputError("mesh", "no face has an area", "give a mesh with at least one proper triangle");
  graph.area = whole * sphere.radius * sphere.radius;
  graph.weight.assign(order.size(), 0);
  for (std::size_t f = 0; f < area.size(); ++f)
    for (int k = 0; k < 3; ++k)
      graph.weight[graph.mesh.faces(static_cast<Eigen::Index>(f), k)] +=
          std::llround(std::ldexp(area[f] / whole / 3, kWeightBits));
  return graph;
}

}  // namespace partwise
