#include "partwise/geometry/subdivide.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "partwise/base/error.h"

namespace partwise {

Subdivision split_long_edges(const Mesh& mesh, double longest, int most_faces) {
  std::vector<Point> vertices;
  for (const auto& row : mesh.vertices.rowwise()) vertices.emplace_back(row);
  std::vector<std::array<int, 3>> faces;
  for (const auto& row : mesh.faces.rowwise()) faces.push_back({row[0], row[1], row[2]});
  std::vector<int> parent(faces.size());
  std::iota(parent.begin(), parent.end(), 0);

  for (bool any = true; any;) {
    any = false;
    std::unordered_map<std::uint64_t, int> middles;
    // The vertex half-way along an edge that is too long, -1 for others. A pure function of the two ends.
    const auto middle = [&](int a, int b) {
      if (a > b) std::swap(a, b);
      if ((vertices[a] - vertices[b]).norm() <= longest) return -1;
      const auto [entry, added] = middles.try_emplace(
          static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b), static_cast<int>(vertices.size()));
      if (added) vertices.emplace_back((vertices[a] + vertices[b]) / 2);
      return entry->second;
    };
    std::vector<std::array<int, 3>> next_faces;
    std::vector<int> next_parent;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::array<int, 3> v = faces[f];
      std::array<int, 3> m{middle(v[0], v[1]), middle(v[1], v[2]), middle(v[2], v[0])};
      const int cuts = (m[0] >= 0) + (m[1] >= 0) + (m[2] >= 0);
      const auto emit = [&](int a, int b, int c) {
        next_faces.push_back({a, b, c});
        next_parent.push_back(parent[f]);
      };
      const auto turn = [&] {
        v = {v[1], v[2], v[0]};
        m = {m[1], m[2], m[0]};
      };
      any = any || cuts > 0;
      if (cuts == 0) {
        emit(v[0], v[1], v[2]);
      } else if (cuts == 1) {
        while (m[0] < 0) turn();
        emit(v[0], m[0], v[2]);
        emit(m[0], v[1], v[2]);
      } else if (cuts == 2) {
        while (m[2] >= 0) turn();  // Edges (0, 1) and (1, 2) are cut.
        emit(m[0], v[1], m[1]);
        emit(v[0], m[0], m[1]);
        emit(v[0], m[1], v[2]);
      } else {
        emit(v[0], m[0], m[2]);
        emit(m[0], v[1], m[1]);
        emit(m[2], m[1], v[2]);
        emit(m[0], m[1], m[2]);
      }
    }
    faces = std::move(next_faces);
    parent = std::move(next_parent);
    if (static_cast<std::int64_t>(faces.size()) > most_faces) {
      throw InputError("mesh", "cutting its long edges makes too many faces", "allow longer edges or remesh it");
    }
  }
  Subdivision result;
  result.mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    result.mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i];
  result.mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < faces.size(); ++i)
    result.mesh.faces.row(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
  result.parent = std::move(parent);
  return result;
}

}  // namespace partwise
