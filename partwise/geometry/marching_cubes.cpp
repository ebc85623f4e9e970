#include "partwise/geometry/marching_cubes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace partwise {
namespace {

// Corner c of a cube lies at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a + n runs along axis a from the n-th corner that is
// low there.
constexpr int corner_count = 8, edge_count = 12;

struct CubeEdge {
  int low, axis;
};

CubeEdge cube_edge(int edge) {
  const int axis = edge / 4, n = edge % 4;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  return {(n & 1) << first | (n >> 1) << second, axis};
}

int edge_between(int a, int b) {
  for (int edge = 0; edge < edge_count; ++edge) {
    const auto [low, axis] = cube_edge(edge);
    if (std::min(a, b) == low && std::max(a, b) == (low | 1 << axis)) return edge;
  }
  return -1;
}

// The corners of face 2 axis + side, counter-clockwise seen from outside of the cube.
std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, side = face % 2;
  const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
  if (side == 1) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

bool share_a_face(int edge, int other) {
  for (int axis = 0; axis < 3; ++axis) {
    const CubeEdge a = cube_edge(edge), b = cube_edge(other);
    if (a.axis != axis && b.axis != axis && (a.low >> axis & 1) == (b.low >> axis & 1)) return true;
  }
  return false;
}

struct Loop {
  std::vector<int> edges;
  bool needs_centre = false;  // every fan from a corner has a diagonal in a face of the cube, where a neighbour has one
};

// Turns the loop so that no diagonal of the fan from its first corner lies in a face of the cube.
void choose_fan(Loop& loop) {
  std::vector<int>& edges = loop.edges;
  for (std::size_t turn = 0; turn < edges.size(); ++turn) {
    bool free = true;
    for (std::size_t i = 2; i + 1 < edges.size(); ++i) free = free && !share_a_face(edges[0], edges[i]);
    if (free) return;
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
  loop.needs_centre = true;
}

// On every face the surface leaves where a walk round the face leaves a run of inside corners, and comes from where the
// walk entered it.
std::vector<Loop> loops_of(int inside) {
  std::array<int, edge_count> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = face_corners(face);
    for (std::size_t start = 0; start < 4; ++start) {
      const int before = corners[(start + 3) % 4];
      if ((inside >> before & 1) || !(inside >> corners[start] & 1)) continue;
      std::size_t last = start;
      while (inside >> corners[(last + 1) % 4] & 1) ++last;
      next[static_cast<std::size_t>(edge_between(before, corners[start]))] =
          edge_between(corners[last % 4], corners[(last + 1) % 4]);
    }
  }
  std::vector<Loop> loops;
  std::array<bool, edge_count> seen{};
  for (int first = 0; first < edge_count; ++first) {
    Loop loop;
    for (int edge = first; next[static_cast<std::size_t>(edge)] >= 0 && !seen[static_cast<std::size_t>(edge)];
         edge = next[static_cast<std::size_t>(edge)]) {
      seen[static_cast<std::size_t>(edge)] = true;
      loop.edges.push_back(edge);
    }
    if (loop.edges.empty()) continue;
    choose_fan(loop);
    loops.push_back(std::move(loop));
  }
  return loops;
}

const std::array<std::vector<Loop>, 256>& all_loops() {
  static const std::array<std::vector<Loop>, 256> table = [] {
    std::array<std::vector<Loop>, 256> loops;
    for (int inside = 0; inside < 256; ++inside) loops[static_cast<std::size_t>(inside)] = loops_of(inside);
    return loops;
  }();
  return table;
}

class Builder {
 public:
  explicit Builder(const SampleGrid& grid) : grid_(grid), layers_{Layer(layer_size(), -1), Layer(layer_size(), -1)} {}

  Mesh build() {
    for (int k = 0; k + 1 < grid_.size[2]; ++k) {
      for (int j = 0; j + 1 < grid_.size[1]; ++j)
        for (int i = 0; i + 1 < grid_.size[0]; ++i) add_cube({i, j, k});
      std::swap(layers_[0], layers_[1]);
      std::fill(layers_[1].begin(), layers_[1].end(), -1);
    }
    Mesh mesh{Vertices(static_cast<Eigen::Index>(vertices_.size()), 3),
              Faces(static_cast<Eigen::Index>(faces_.size()), 3)};
    for (std::size_t v = 0; v < vertices_.size(); ++v) mesh.vertices.row(static_cast<Eigen::Index>(v)) = vertices_[v];
    for (std::size_t f = 0; f < faces_.size(); ++f)
      mesh.faces.row(static_cast<Eigen::Index>(f)) << faces_[f][0], faces_[f][1], faces_[f][2];
    return mesh;
  }

 private:
  using Cell = std::array<int, 3>;
  using Layer = std::vector<int>;  // of each sample of a layer and each axis the vertex on the line that starts there

  std::size_t layer_size() const {
    return 3 * static_cast<std::size_t>(grid_.size[0]) * static_cast<std::size_t>(grid_.size[1]);
  }
  static Cell corner(const Cell& cell, int c) {
    return {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
  }
  double value(const Cell& at) const { return grid_.values[grid_.index(at[0], at[1], at[2])]; }

  int vertex_on(const Cell& cell, int edge) {
    const auto [low, axis] = cube_edge(edge);
    const Cell a = corner(cell, low);
    int& vertex = layers_[static_cast<std::size_t>(a[2] - cell[2])]
                         [3 * grid_.index(a[0], a[1], 0) + static_cast<std::size_t>(axis)];
    if (vertex >= 0) return vertex;
    const double from = value(a), to = value(corner(cell, low | 1 << axis));
    Point at(a[0], a[1], a[2]);
    at[axis] += std::clamp(from / (from - to), 0.05, 0.95);
    vertices_.push_back(grid_.low + grid_.spacing * at);
    return vertex = static_cast<int>(vertices_.size()) - 1;
  }

  void add_cube(const Cell& cell) {
    int inside = 0;
    for (int c = 0; c < corner_count; ++c) inside |= (value(corner(cell, c)) < 0) << c;
    for (const Loop& loop : all_loops()[static_cast<std::size_t>(inside)]) {
      corners_.clear();
      for (const int edge : loop.edges) corners_.push_back(vertex_on(cell, edge));
      if (loop.needs_centre) {
        Point centre = Point::Zero();
        for (const int v : corners_) centre += vertices_[static_cast<std::size_t>(v)];
        vertices_.push_back(centre / static_cast<double>(corners_.size()));
        const int apex = static_cast<int>(vertices_.size()) - 1;
        for (std::size_t n = 0; n < corners_.size(); ++n)
          faces_.push_back({apex, corners_[n], corners_[(n + 1) % corners_.size()]});
      } else {
        for (std::size_t n = 1; n + 1 < corners_.size(); ++n)
          faces_.push_back({corners_[0], corners_[n], corners_[n + 1]});
      }
    }
  }

  const SampleGrid& grid_;
  std::array<Layer, 2> layers_;  // below and above the cubes at hand
  std::vector<Point> vertices_;
  std::vector<std::array<int, 3>> faces_;
  std::vector<int> corners_;
};

}  // namespace

std::vector<bool> reached_from_outside(const SampleGrid& grid, double seal) {
  std::vector<bool> outside(grid.values.size());
  std::vector<std::array<int, 3>> front{{0, 0, 0}}, reached;
  outside[0] = true;
  const auto spread = [&](const std::array<int, 3>& at, double above, std::vector<std::array<int, 3>>& next) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        std::array<int, 3> beside = at;
        beside[axis] += step;
        if (beside[axis] < 0 || beside[axis] >= grid.size[axis]) continue;
        const std::size_t index = grid.index(beside[0], beside[1], beside[2]);
        if (outside[index] || grid.values[index] < above) continue;
        outside[index] = true;
        next.push_back(beside);
      }
  };
  while (!front.empty()) {
    const std::array<int, 3> at = front.back();
    front.pop_back();
    if (seal > 0) reached.push_back(at);
    spread(at, seal, front);
  }
  // Back through the samples that the wide way did not reach. Along the grid's lines a way of one seal is at most
  // sqrt(3) long.
  const int steps = seal > 0 ? 1 + static_cast<int>(std::ceil(std::sqrt(3.0) * seal / grid.spacing)) : 0;
  for (int step = 0; step < steps; ++step) {
    std::vector<std::array<int, 3>> next;
    for (const auto& at : reached) spread(at, 0, next);
    reached = std::move(next);
  }
  return outside;
}

void fill_hollows(SampleGrid& grid, double seal) {
  const std::vector<bool> outside = reached_from_outside(grid, seal);
  for (std::size_t i = 0; i < outside.size(); ++i)
    if (!outside[i]) grid.values[i] = std::min(grid.values[i], -1e-6f);
}

Mesh marching_cubes(const SampleGrid& grid) { return Builder(grid).build(); }

}  // namespace partwise
