// Connectivity of triangle meshes of any kind: open, non-manifold, with repeated or degenerate faces.
//
// A half-edge is the passage of a face along one of its sides, from one vertex to the next; an edge is an unordered
// pair of vertices. A face that names a vertex twice is degenerate: it bounds nothing, has no half-edges here and no
// neighbours across edges, but it still joins its vertices. Indices are not checked against the number of vertices:
// read_mesh has done that. Time O(n + m), but for the sorting of the edges about one vertex. Flat arrays throughout.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct HalfEdge {
  int low = 0, high = 0;  // its two vertices, low < high
  int face = 0;
  int corner = 0;        // 0, 1 or 2: where in the face it starts
  bool forward = false;  // it runs from low to high
};

// All half-edges by ascending (low, high, face, corner): those of an edge stand together.
std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh);

// Calls visit(std::span<const HalfEdge>) for every edge, with its half-edges.
template <typename Visit>
void for_each_edge(const std::vector<HalfEdge>& sorted, const Visit& visit) {
  for (std::size_t first = 0, last; first < sorted.size(); first = last) {
    last = first + 1;
    while (last < sorted.size() && sorted[last].low == sorted[first].low && sorted[last].high == sorted[first].high)
      ++last;
    visit(std::span<const HalfEdge>(sorted).subspan(first, last - first));
  }
}

// True when every edge is passed as often one way as the other, and there is a face that is not degenerate. Such a mesh
// has a volume and an integer winding number at every point off it, non-manifold edges or not.
bool is_watertight(const Mesh& mesh);

// The faces across the edges of face f are neighbours[first[f]] .. neighbours[first[f + 1] - 1], ascending, each once.
// Where k > 2 faces share an edge, they are joined as a chain by ascending index (each with the one before and the one
// after), so that they stay connected and the lists stay linear in size.
struct FaceAdjacency {
  std::vector<int> first;  // m + 1
  std::vector<int> neighbours;

  std::span<const int> of(int face) const {
    return std::span<const int>(neighbours).subspan(first[face], first[face + 1] - first[face]);
  }
};
FaceAdjacency face_adjacency(const Mesh& mesh);

// Connected components, numbered in the order of their first member.
struct Components {
  std::vector<int> label;  // of each face or vertex
  int count = 0;
};

// Faces are connected when they share a vertex.
Components face_components_by_vertex(const Mesh& mesh);
// Vertices are connected when a face names both. A vertex that no face uses is a component of its own.
Components vertex_components(const Mesh& mesh);

// Faces turned so that neighbours agree, by reversing their last two corners.
//
// Two faces are neighbours here when they are the only two at an edge. In a patch of neighbours that disagree, the side
// with less area is turned (equal areas: the one without the patch's first face); a patch that agrees stays as it is,
// and so does one that cannot agree (a Moebius band). Afterwards, if the closed part of the mesh (the pieces, connected
// across edges of any kind, that are watertight) has negative volume in all, it is turned inside out.
Mesh orient_consistently(const Mesh& mesh);

// Vertices within `tolerance` (model units) of an earlier kept one become that one, so none moves farther. Kept
// vertices are in order of their first appearance, faces keep their order, and those that collapse stay. Tolerance 0
// joins equal positions only (0 and -0 are equal); one below 1e-15 of the largest coordinate is below its rounding and
// counts as 0. Errors: InputError for a negative or non-finite tolerance.
Mesh weld(const Mesh& mesh, double tolerance = 0);

}  // namespace partwise
