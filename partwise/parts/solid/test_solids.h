// Shapes that several tests of this room share.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/surface_query.h"

namespace partwise::test {

using Cell = std::array<int, 3>;

inline std::vector<int> all_faces(const Mesh& mesh) {
  std::vector<int> faces(static_cast<std::size_t>(mesh.faces.rows()));
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

inline Mesh mesh_of(const std::vector<Point>& vertices, const std::vector<std::array<int, 3>>& faces) {
  Mesh mesh{Vertices(static_cast<Eigen::Index>(vertices.size()), 3), Faces(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i];
  for (std::size_t f = 0; f < faces.size(); ++f)
    mesh.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return mesh;
}

// The boundary of a union of unit cells, every square cut in two.
inline Mesh cells_mesh(const std::set<Cell>& cells) {
  std::map<Cell, int> number;
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;
  const auto vertex = [&](const Cell& at) {
    const auto [entry, added] = number.try_emplace(at, static_cast<int>(vertices.size()));
    if (added) vertices.emplace_back(at[0], at[1], at[2]);
    return entry->second;
  };
  for (const Cell& cell : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (int up = 0; up < 2; ++up) {
        Cell beside = cell;
        beside[axis] += up ? 1 : -1;
        if (cells.contains(beside)) continue;
        Cell base = cell;
        base[axis] += up;
        const auto at = [&](int u, int v) {
          Cell c = base;
          c[(axis + 1) % 3] += u;
          c[(axis + 2) % 3] += v;
          return vertex(c);
        };
        const int a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
        if (up) {
          faces.push_back({a, b, c}), faces.push_back({a, c, d});
        } else {
          faces.push_back({a, c, b}), faces.push_back({a, d, c});
        }
      }
  return mesh_of(vertices, faces);
}

// The cells of a box, low <= cell < high.
inline std::set<Cell> block(const Cell& low, const Cell& high) {
  std::set<Cell> cells;
  for (int x = low[0]; x < high[0]; ++x)
    for (int y = low[1]; y < high[1]; ++y)
      for (int z = low[2]; z < high[2]; ++z) cells.insert({x, y, z});
  return cells;
}

inline std::set<Cell> united(std::set<Cell> a, const std::set<Cell>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

inline std::set<Cell> without(std::set<Cell> a, const std::set<Cell>& b) {
  for (const Cell& c : b) a.erase(c);
  return a;
}

// Two arms of length n and width w, depth w.
inline Mesh l_shape(int n, int w) {
  return cells_mesh(united(block({0, 0, 0}, {n, w, w}), block({0, 0, 0}, {w, n, w})));
}

// A square of side n with a notch from above, n - 2 w wide, down to height w; depth w.
inline Mesh u_shape(int n, int w) {
  return cells_mesh(without(block({0, 0, 0}, {n, n, w}), block({w, w, 0}, {n - w, n, w})));
}

// Six corners an end, 20 faces: two arms of length 3 and width 1, depth 1.
inline Mesh coarse_l() {
  const std::array<std::array<double, 2>, 6> outline{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}};
  std::vector<Point> vertices;
  for (double z : {0.0, 1.0})
    for (const auto& p : outline) vertices.emplace_back(p[0], p[1], z);
  std::vector<std::array<int, 3>> faces;
  for (const std::array<int, 3>& t : {std::array{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    faces.push_back({t[0], t[2], t[1]});
    faces.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    faces.push_back({i, j, j + 6});
    faces.push_back({i, j + 6, i + 6});
  }
  return mesh_of(vertices, faces);
}

// A surface of revolution about the z axis: rings of `around` vertices at (radius, z), closed by an apex at either end.
inline Mesh revolved(const std::vector<std::array<double, 2>>& rings, double bottom, double top, int around) {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;
  const int rows = static_cast<int>(rings.size());
  for (const auto& [radius, z] : rings)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  vertices.emplace_back(0, 0, bottom);
  vertices.emplace_back(0, 0, top);
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    faces.push_back({rows * around, next, k});
    for (int r = 0; r + 1 < rows; ++r) {
      const int a = r * around + k, b = r * around + next;
      faces.push_back({a, b, b + around});
      faces.push_back({a, b + around, a + around});
    }
    faces.push_back({(rows - 1) * around + k, (rows - 1) * around + next, rows * around + 1});
  }
  return mesh_of(vertices, faces);
}

inline Mesh sphere(int rows, int around) {
  std::vector<std::array<double, 2>> rings;
  for (int r = 1; r < rows; ++r) {
    const double angle = std::numbers::pi * r / rows;
    rings.push_back({std::sin(angle), -std::cos(angle)});
  }
  return revolved(rings, -1, 1, around);
}

// Two balls of radius 1, centres at z = -2 and 2, joined by a bar of radius 0.3.
inline Mesh dumbbell(int around = 24) {
  std::vector<std::array<double, 2>> rings;
  const double end = std::asin(0.3);
  const auto ball = [&](double centre, double from, double to) {
    const int steps = 12;
    for (int r = 0; r <= steps; ++r) {
      const double angle = from + (to - from) * r / steps;
      rings.push_back({std::sin(angle), centre - std::cos(angle)});
    }
  };
  ball(-2, std::numbers::pi / 13, std::numbers::pi - end);
  for (int r = 1; r < 10; ++r) rings.push_back({0.3, (2 - std::cos(end)) * (2 * r / 10.0 - 1)});
  ball(2, end, std::numbers::pi * 12 / 13);
  return revolved(rings, -3, 3, around);
}

// The wall and the bottom of a cup, open at the top, without thickness; the bottom at z = 0.
inline Mesh open_cup(double radius, double height, int around) {
  std::vector<std::array<double, 2>> rings;
  constexpr int kRows = 10;
  for (int r = 1; r < kRows; ++r) rings.push_back({radius * r / kRows, 0});
  for (int r = 0; r <= kRows; ++r) rings.push_back({radius, height * r / kRows});
  Mesh mesh = revolved(rings, 0, 0, around);
  std::vector<std::array<int, 3>> faces;
  const int top = static_cast<int>(mesh.vertices.rows()) - 1;
  for (const auto& f : mesh.faces.rowwise())
    if (f.maxCoeff() < top) faces.push_back({f[0], f[1], f[2]});
  std::vector<Point> vertices;
  for (int v = 0; v < top; ++v) vertices.emplace_back(mesh.vertices.row(v));
  return mesh_of(vertices, faces);
}

// A cup that stands on z = 0, wall and bottom equally thick, its mouth at z = height.
inline Mesh cup(double radius, double height, double wall, int around) {
  std::vector<std::array<double, 2>> rings;
  constexpr int kRows = 10;
  const double inner = radius - wall;
  for (int r = 1; r < kRows; ++r) rings.push_back({radius * r / kRows, 0});
  for (int r = 0; r <= kRows; ++r) rings.push_back({radius, height * r / kRows});
  for (int r = kRows; r >= 0; --r) rings.push_back({inner, wall + (height - wall) * r / kRows});
  for (int r = kRows - 1; r > 0; --r) rings.push_back({inner * r / kRows, wall});
  return revolved(rings, 0, wall, around);
}

inline Mesh torus(double large, double small, int around, int across) {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      vertices.emplace_back((large + small * std::cos(v)) * std::cos(u), (large + small * std::cos(v)) * std::sin(u),
                            small * std::sin(v));
      const int a = i * across + j, b = (i + 1) % around * across + j, c = i * across + (j + 1) % across,
                d = (i + 1) % around * across + (j + 1) % across;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  return mesh_of(vertices, faces);
}

// An n x n grid of squares in the plane z = 0, folded up by 90 degrees along x = fold; n: flat.
inline Mesh sheet(int n, int fold) {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) vertices.emplace_back(std::min(x, fold), y, std::max(0, x - fold));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      faces.push_back({a, a + 1, a + n + 2});
      faces.push_back({a, a + n + 2, a + n + 1});
    }
  return mesh_of(vertices, faces);
}

inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh both{Vertices(a.vertices.rows() + b.vertices.rows(), 3), Faces(a.faces.rows() + b.faces.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
  return both;
}

inline Mesh moved(Mesh mesh, const Point& by) {
  mesh.vertices.rowwise() += by;
  return mesh;
}

// Centred, with a bounding sphere of radius 1.
inline Mesh normalised(Mesh mesh) {
  const Sphere sphere = bounding_sphere(mesh);
  mesh.vertices = ((mesh.vertices.rowwise() - sphere.centre) / sphere.radius).eval();
  return mesh;
}

}  // namespace partwise::test
