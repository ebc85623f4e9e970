#include "bench/check/labelling.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace partwise::bench {
namespace {

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Vertices of each label's faces.
std::vector<std::vector<int>> part_vertices(const Shape& shape, const std::vector<int>& labels, int parts) {
  std::vector<std::vector<int>> result(parts);
  for (std::size_t f = 0; f < labels.size(); ++f)
    result[labels[f]].insert(result[labels[f]].end(), shape.faces[f].begin(), shape.faces[f].end());
  for (std::vector<int>& vertices : result) {
    std::ranges::sort(vertices);
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  }
  return result;
}

bool connected(const Shape& shape, const std::vector<int>& labels, const std::vector<std::vector<int>>& vertices) {
  std::vector<int> parent(shape.vertices.size());
  for (int part = 0; part < static_cast<int>(vertices.size()); ++part) {
    if (vertices[part].empty()) return false;
    for (const int v : vertices[part]) parent[v] = v;
    for (std::size_t f = 0; f < labels.size(); ++f)
      if (labels[f] == part)
        for (const int corner : shape.faces[f]) parent[root(parent, corner)] = root(parent, shape.faces[f][0]);
    const int first = root(parent, vertices[part].front());
    if (!std::ranges::all_of(vertices[part], [&](int v) { return root(parent, v) == first; })) return false;
  }
  return true;
}

double outside(const Shape& shape, const std::vector<int>& vertices, const Hull& hull) {
  double largest = 0;
  for (const int v : vertices) largest = std::max(largest, hull.outside(shape.vertices[v]));
  return largest;
}

}  // namespace

Labelling judge_labels(const Shape& shape, const std::vector<int>& labels, const std::vector<Hull>& hulls) {
  Labelling result;
  const std::set<int> distinct(labels.begin(), labels.end());
  result.parts = static_cast<int>(distinct.size());
  result.complete = labels.size() == shape.faces.size() && !distinct.empty() && *distinct.begin() == 0 &&
                    *distinct.rbegin() == result.parts - 1;
  if (!result.complete) {
    result.parts_connected = result.hulls_match = false;
    result.hull_outside = result.outside_all = std::numeric_limits<double>::infinity();
    return result;
  }
  const std::vector<std::vector<int>> vertices = part_vertices(shape, labels, result.parts);
  result.parts_connected = connected(shape, labels, vertices);
  for (int part = 0; part < result.parts; ++part) {
    const bool has_hull = part < static_cast<int>(hulls.size());
    const double own = has_hull ? outside(shape, vertices[part], hulls[part]) : std::numeric_limits<double>::infinity();
    if (own > result.hull_outside) result.hull_outside = own, result.worst_part = part;
    if (own == 0) continue;
    for (const Hull& hull : hulls) result.hulls_match &= outside(shape, vertices[part], hull) >= own;
    for (const int v : vertices[part]) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Hull& hull : hulls) nearest = std::min(nearest, hull.outside(shape.vertices[v]));
      result.outside_all = std::max(result.outside_all, nearest);
    }
  }
  return result;
}

}  // namespace partwise::bench
