#include "partwise/geometry/half_edge_sphere.h"

#include <algorithm>
#include <tuple>

#include "partwise/base/error.h"

namespace partwise {

HalfEdgeSphere::HalfEdgeSphere(const Mesh& mesh)
    : origin(static_cast<std::size_t>(3 * mesh.faces.rows())),
      twin(origin.size(), -1),
      out(static_cast<std::size_t>(mesh.vertices.rows()), -1),
      alive(origin.size(), 1),
      mark_(out.size(), 0) {
  std::copy(mesh.faces.data(), mesh.faces.data() + mesh.faces.size(), origin.begin());
  // Sorted by their ends, the two half-edges of an edge are neighbours.
  std::vector<std::tuple<int, int, int>> ends;
  for (int h = 0; h < size(); ++h) {
    ends.emplace_back(std::min(origin[h], target(h)), std::max(origin[h], target(h)), h);
    if (out[origin[h]] < 0) ++vertex_count;
    out[origin[h]] = h;
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    const auto [a, b, h] = ends[i];
    const auto [c, d, g] = ends[i + 1];
    if (a != c || b != d || origin[h] == origin[g]) break;
    twin[h] = g;
    twin[g] = h;
  }
  PARTWISE_CHECK(std::count(twin.begin(), twin.end(), -1), ==, 0);
}

bool HalfEdgeSphere::collapsible(int h) {
  if (vertex_count <= 4) return false;
  ++call_;
  int g = h;
  do mark_[target(g)] = call_;
  while ((g = around(g)) != h);
  int common = 0;
  const int back = g = twin[h];
  do common += mark_[target(g)] == call_;
  while ((g = around(g)) != back);
  return common == 2;
}

void HalfEdgeSphere::collapse(int h) {
  const int t = twin[h], kept = origin[h], gone = origin[t];
  int g = t;
  do origin[g] = kept;
  while ((g = around(g)) != t);
  for (int side : {h, t}) {
    const int a = twin[next(side)], b = twin[previous(side)];
    twin[a] = b;
    twin[b] = a;
    out[origin[a]] = a;
    out[origin[b]] = b;
    for (int dead : {side, next(side), previous(side)}) alive[dead] = 0;
  }
  out[gone] = -1;
  --vertex_count;
}

Faces HalfEdgeSphere::faces() const {
  Faces faces(std::count(alive.begin(), alive.end(), 1) / 3, 3);
  Eigen::Index row = 0;
  for (int h = 0; h < size(); h += 3)
    if (alive[h]) faces.row(row++) << origin[h], origin[h + 1], origin[h + 2];
  return faces;
}

}  // namespace partwise
