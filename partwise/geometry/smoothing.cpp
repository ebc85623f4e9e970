#include "partwise/geometry/smoothing.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr double forth = 0.5;                         // Taubin's lambda
constexpr double pass_band = 0.1;                     // frequencies below it stay
constexpr double back = 1 / (pass_band - 1 / forth);  // his mu

// Whom each vertex follows: those of v are list[first[v]] .. list[first[v + 1] - 1].
struct Neighbours {
  std::vector<int> first, list;
};

Neighbours neighbours_of(const Mesh& mesh) {
  std::vector<std::pair<int, int>> all, along_border;  // `all` becomes both
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    const auto [low, high] = std::pair(edge[0].low, edge[0].high);
    std::vector<std::pair<int, int>>& pairs = edge.size() == 1 ? along_border : all;
    pairs.emplace_back(low, high);
    pairs.emplace_back(high, low);
  });
  std::vector<char> on_border(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  for (const auto& [from, to] : along_border) on_border[from] = 1;
  std::erase_if(all, [&](const std::pair<int, int>& each) { return on_border[each.first] != 0; });
  all.insert(all.end(), along_border.begin(), along_border.end());
  std::sort(all.begin(), all.end());
  Neighbours result;
  result.first.assign(on_border.size() + 1, 0);
  for (const auto& [from, to] : all) {
    ++result.first[from + 1];
    result.list.push_back(to);
  }
  for (std::size_t v = 0; v < on_border.size(); ++v) result.first[v + 1] += result.first[v];
  return result;
}

void step(const Neighbours& neighbours, double share, Vertices& vertices) {
  const Vertices before = vertices;
  for (int v = 0; v < static_cast<int>(before.rows()); ++v) {
    const int first = neighbours.first[v], last = neighbours.first[v + 1];
    if (first == last) continue;
    Point sum = Point::Zero();
    for (int i = first; i < last; ++i) sum += before.row(neighbours.list[i]);
    vertices.row(v) += share * (sum / (last - first) - before.row(v));
  }
}

}  // namespace

Mesh smoothed(const Mesh& mesh, int rounds) {
  PARTWISE_CHECK(rounds, >=, 0);
  Mesh joined = weld(mesh);
  const Neighbours neighbours = neighbours_of(joined);
  for (int round = 0; round < rounds; ++round) {
    step(neighbours, forth, joined.vertices);
    step(neighbours, back, joined.vertices);
  }
  Mesh result = mesh;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) result.vertices.row(mesh.faces(f, k)) = joined.vertices.row(joined.faces(f, k));
  }
  return result;
}

}  // namespace partwise
