// The constrained Delaunay triangulation of points in the plane: incremental (Lawson 1977), constraints by flipping
// what they cross (Sloan 1993). Exact orientation tests, so that it is a triangulation whatever the points.
//
// Vertices are named by their index in the points given. Edges that were asked for are fixed; an edge that runs through
// other points is fixed piece by piece. O(n log n) for points in general use.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "partwise/geometry/orientation.h"

namespace partwise {

class ConstrainedDelaunay {
 public:
  // v: corners counter-clockwise. Edge i is the one opposite to corner i, from v[i + 1] to v[i + 2].
  struct Triangle {
    std::array<int, 3> v;
    std::array<int, 3> neighbour;  // -1: none
    std::array<bool, 3> fixed{};
    bool inside = false;
  };

  // The points must be distinct and finite.
  explicit ConstrainedDelaunay(std::span<const Point2> points);

  // Fixes the edge a b. False, and nothing changed, when a fixed edge is in the way.
  bool insert_edge(int a, int b);

  // Marks as inside what an odd number of fixed edges separates from infinity. Later edges do not change it.
  void mark_inside();

  // The fixed edges that the open segment a b crosses, from a to b. `through_vertex` tells that it runs through a
  // vertex, where the list then ends; `inside` whether it leaves a through an inside triangle.
  struct Walk {
    std::vector<std::pair<int, int>> crossed;
    bool through_vertex = false;
    bool inside = false;
  };
  Walk walk(int a, int b) const;

  bool has_edge(int a, int b) const { return find_edge(a, b).first >= 0; }

  // The other ends of the edges at `vertex` that have inside triangles on both sides.
  std::vector<int> inside_neighbours(int vertex) const;

  // All triangles; those with a corner beyond the points (index >= point_count()) belong to the frame around them.
  std::span<const Triangle> triangles() const { return triangles_; }
  int point_count() const { return point_count_; }

 private:
  static int next(int i) { return i == 2 ? 0 : i + 1; }
  static int previous(int i) { return i == 0 ? 2 : i - 1; }
  int corner_of(int triangle, int vertex) const;
  int side(int a, int b, int c) const { return orientation(points_[a], points_[b], points_[c]); }
  std::pair<int, int> find_edge(int a, int b) const;  // triangle, and the corner opposite to the edge from a to b

  // Where the segment a b leaves the triangles at a: either through the edge opposite to a, or along an edge to the
  // vertex `on`.
  struct Departure {
    int triangle = -1, corner = -1, on = -1;
  };
  Departure depart(int a, int b) const;

  void insert_point(int vertex);
  void legalise(std::vector<std::pair<int, int>>& edges);
  void flip(int triangle, int corner);
  void set_neighbour(int triangle, int old_neighbour, int new_neighbour);
  bool insert_clear_edge(int a, int b);

  int point_count_;
  std::vector<Point2> points_;  // and three that frame them
  std::vector<Triangle> triangles_;
  std::vector<int> at_;  // one triangle at each vertex
  int last_ = 0;         // where the next search begins
};

}  // namespace partwise
