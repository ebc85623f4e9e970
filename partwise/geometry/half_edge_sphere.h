// A closed triangle mesh of the topology of a sphere as half-edges, and the collapse of its edges.
//
// Half-edge h runs from origin[h] to origin[next[h]] with its face on the left, seen from outside; face f of the mesh
// owns the half-edges 3 f, 3 f + 1 and 3 f + 2. Collapsed half-edges stay in the arrays with alive[h] = 0.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

class HalfEdgeSphere {
 public:
  // Fails (CheckFailed) unless every edge has two faces that pass it in opposite directions.
  explicit HalfEdgeSphere(const Mesh& mesh);

  int size() const { return static_cast<int>(origin.size()); }
  int target(int h) const { return origin[next(h)]; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  // The next half-edge with the same origin, counter-clockwise seen from outside.
  int around(int h) const { return twin[previous(h)]; }

  // True when the collapse of h leaves the topology of a sphere: its ends have exactly two common neighbours.
  bool collapsible(int h);
  // Moves target(h) into origin[h]; the two faces at h go.
  void collapse(int h);

  Faces faces() const;  // those alive

  std::vector<int> origin, twin;  // of each half-edge
  std::vector<int> out;           // of each vertex one half-edge that leaves it, -1 for none
  std::vector<char> alive;        // of each half-edge
  int vertex_count = 0;           // vertices that still have faces

 private:
  std::vector<int> mark_;  // of each vertex the last call of collapsible() that saw it
  int call_ = 0;
};

}  // namespace partwise
