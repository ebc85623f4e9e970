// A part of a mesh, some of its faces, with the graphs that convex ridge separation walks on.
//
// Vertices and faces are numbered anew from 0 (local), in ascending order of their number in the mesh (global). Paths
// run over the edges of the part and over the straight lines between the two corners opposite an edge, where the two
// faces unfolded into a plane form a convex quadrilateral: twice the directions, so that a path strays less from the
// geodesic.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct PartGraph {
  std::vector<int> vertices;                // global number of each local vertex
  std::vector<int> faces;                   // global number of each local face
  Vertices positions;                       // of the local vertices
  std::vector<std::array<int, 3>> corners;  // local vertices of each local face

  // From local vertex v go steps[i], i in [first[v], first[v + 1]).
  struct Step {
    int to;
    double length;
  };
  std::vector<int> first;
  std::vector<Step> steps;

  // Pairs of faces that share an edge (a, b); round an edge of more than two faces, each with the next.
  struct SharedEdge {
    int face, other;  // local
    int a, b;         // local vertices
  };
  std::vector<SharedEdge> shared;

  int size() const { return static_cast<int>(vertices.size()); }
};

// `faces`: global face numbers, ascending.
PartGraph part_graph(const Mesh& mesh, std::span<const int> faces);

// Connected (by vertices) groups of the faces listed, each ascending, in the order of their first face.
std::vector<std::vector<int>> connected_groups(const Mesh& mesh, const std::vector<int>& faces);

// Shortest paths in a part's graph. Keeps its arrays from one search to the next.
class PathSearch {
 public:
  explicit PathSearch(const PartGraph& graph);

  // Length of the shortest path from a to b if it is at most `at_most`, else infinity. Looks only where a path of
  // that length can pass: d(a, v) + |v b| <= at_most.
  double bounded_length(int a, int b, double at_most);

  // Whether bounded_length() is finite, sooner: any path of that length will do.
  bool has_path(int a, int b, double at_most);

  // Distances and paths from `source` to each target: Dijkstra (1959) with buckets of distances in place of a heap. A
  // vertex may be reached again on a shorter way through its own bucket, and is then taken from it once more.
  void from(int source, std::span<const int> targets);
  // After from(): the path source .. target.
  std::vector<int> path_to(int target) const;

  // For every vertex the least of d(source, v) - reach(source) over the sources, where that is negative; else 0.
  std::vector<double> within_reach(std::span<const std::pair<int, double>> sources);

 private:
  void begin();
  bool relax(int v, double distance, int previous);

  const PartGraph& graph_;
  std::vector<double> distance_;
  std::vector<int> previous_;
  std::vector<int> seen_;
  int round_ = 0;
  std::vector<std::pair<double, int>> heap_;
  double width_ = 1;                                       // of a bucket
  std::vector<std::vector<std::pair<double, int>>> ring_;  // buckets, used in turns: no step is longer than all
};

}  // namespace partwise
