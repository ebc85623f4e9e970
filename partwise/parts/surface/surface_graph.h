// A mesh made ready for searches over its vertices: vertices at the same place are one, those without a face are gone,
// and they are numbered along a Morton curve, so that neighbours in space are near in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct SurfaceGraph {
  Mesh mesh;          // centred and scaled to a bounding sphere of radius 1, vertices renumbered, faces in order
  double radius = 1;  // of the input's bounding sphere
  std::vector<int> of_input;  // number of each input vertex here; -1 for those without a face

  // Vertices joined by a side of a face, and the faces at a vertex: lists, one after the other.
  std::vector<int> first_neighbour, neighbour_list, first_face, face_list;

  // A third of the area of the faces at each vertex, as a share of the whole, times 2^62: whole numbers add up to the
  // same sum in any order.
  std::vector<std::int64_t> weight;
  double area = 0;  // of the input, its units squared

  int size() const { return static_cast<int>(mesh.vertices.rows()); }
  std::span<const int> neighbours(int v) const {
    return std::span(neighbour_list).subspan(first_neighbour[v], first_neighbour[v + 1] - first_neighbour[v]);
  }
  std::span<const int> faces(int v) const {
    return std::span(face_list).subspan(first_face[v], first_face[v + 1] - first_face[v]);
  }
  // Area in units of the input of a sum of weights.
  double area_of(std::int64_t weights) const;
};

// Errors: InputError for a mesh without a face of positive area.
SurfaceGraph surface_graph(const Mesh& mesh);

}  // namespace partwise
