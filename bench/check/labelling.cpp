#include "bench/check/labelling.h"

#include <algorithm>
#include <limits>
#include <set>

namespace partwise::bench {
namespace {

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

struct Part {
  std::vector<int> faces, vertices;
};

std::vector<Part> split(const Shape& shape, const std::vector<int>& labels, int count) {
  std::vector<Part> parts(count);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    Part& part = parts[labels[f]];
    part.faces.push_back(static_cast<int>(f));
    part.vertices.insert(part.vertices.end(), shape.faces[f].begin(), shape.faces[f].end());
  }
  for (Part& part : parts) {
    std::ranges::sort(part.vertices);
    part.vertices.erase(std::ranges::unique(part.vertices).begin(), part.vertices.end());
  }
  return parts;
}

bool all_connected(const Shape& shape, const std::vector<Part>& parts) {
  std::vector<int> parent(shape.vertices.size());
  for (const Part& part : parts) {
    for (const int v : part.vertices) parent[v] = v;
    for (const int f : part.faces)
      for (const int corner : shape.faces[f]) parent[root(parent, corner)] = root(parent, shape.faces[f][0]);
    const int first = root(parent, part.vertices.front());
    if (!std::ranges::all_of(part.vertices, [&](int v) { return root(parent, v) == first; })) return false;
  }
  return true;
}

double outside(const Shape& shape, const std::vector<int>& vertices, const Hull& hull) {
  double largest = 0;
  for (const int v : vertices) largest = std::max(largest, hull.outside(shape.vertices[v]));
  return largest;
}

}  // namespace

Labelling judge_labels(const Shape& shape, const std::vector<int>& labels, const std::vector<Hull>& hulls,
                       double slack) {
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
  const std::vector<Part> parts = split(shape, labels, result.parts);
  result.parts_connected = all_connected(shape, parts);
  for (int part = 0; part < result.parts; ++part) {
    const bool has_hull = part < static_cast<int>(hulls.size());
    const double own =
        has_hull ? outside(shape, parts[part].vertices, hulls[part]) : std::numeric_limits<double>::infinity();
    if (own > result.hull_outside) result.hull_outside = own, result.worst_part = part;
    if (own == 0) continue;
    for (const Hull& hull : hulls) result.hulls_match &= outside(shape, parts[part].vertices, hull) >= own - slack;
    for (const int v : parts[part].vertices) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Hull& hull : hulls) nearest = std::min(nearest, hull.outside(shape.vertices[v]));
      result.outside_all = std::max(result.outside_all, nearest);
    }
  }
  return result;
}

}  // namespace partwise::bench
