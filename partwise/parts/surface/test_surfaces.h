// Surfaces, most of them smooth and closed, and CGAL's view of a mesh, that several tests of this room share.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise::test {

// radius(t), height(t) for t in [0, 1], turned about the z axis; radius is taken as 0 at both ends, and height ascends.
template <typename Radius, typename Height>
Mesh revolved(const Radius& radius, const Height& height, int rings, int sides) {
  Mesh mesh{Vertices((rings - 1) * sides + 2, 3), Faces(2 * (rings - 1) * sides, 3)};
  const int bottom = (rings - 1) * sides, top = bottom + 1;
  mesh.vertices.row(bottom) << 0, 0, height(0.0);
  mesh.vertices.row(top) << 0, 0, height(1.0);
  int face = 0;
  for (int ring = 0; ring + 1 < rings; ++ring) {
    const double t = (ring + 1.0) / rings;
    for (int side = 0; side < sides; ++side) {
      // Every other ring is turned by half a step, for triangles of good shape.
      const double around = 2 * std::numbers::pi * (side + 0.5 * (ring % 2)) / sides;
      mesh.vertices.row(ring * sides + side) << radius(t) * std::cos(around), radius(t) * std::sin(around), height(t);
      const int a = ring * sides + side, b = ring * sides + (side + 1) % sides;
      if (ring == 0) mesh.faces.row(face++) << bottom, b, a;
      if (ring + 2 == rings) {
        mesh.faces.row(face++) << a, b, top;
        continue;
      }
      const int c = a + sides, d = b + sides;
      if (ring % 2 == 0) {
        mesh.faces.row(face++) << a, b, c;
        mesh.faces.row(face++) << b, d, c;
      } else {
        mesh.faces.row(face++) << a, b, d;
        mesh.faces.row(face++) << a, d, c;
      }
    }
  }
  return mesh;
}

inline Mesh sphere(double radius, int rings) {
  return revolved([&](double t) { return radius * std::sin(std::numbers::pi * t); },
                  [&](double t) { return -radius * std::cos(std::numbers::pi * t); }, rings, 2 * rings);
}

// A strip of `squares` unit squares along x, two faces each.
inline Mesh strip(int squares) {
  Mesh mesh{Vertices(2 * squares + 2, 3), Faces(2 * squares, 3)};
  for (int i = 0; i <= squares; ++i) {
    mesh.vertices.row(2 * i) << i, 0, 0;
    mesh.vertices.row(2 * i + 1) << i, 1, 0;
  }
  for (int i = 0; i < squares; ++i) {
    mesh.faces.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
    mesh.faces.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
  }
  return mesh;
}

// Two balls of radius 1, their centres 3 apart, and a thin rod between them.
inline Mesh dumbbell(int rings, int sides) {
  const auto height = [](double t) { return -2.5 + 5 * t; };
  const auto radius = [&](double t) {
    const double beyond = std::abs(std::abs(height(t)) - 1.5);
    return std::max(std::abs(height(t)) < 1.5 ? 0.25 : 0.0, std::sqrt(std::max(0.0, 1 - beyond * beyond)));
  };
  return revolved(radius, height, rings, sides);
}

inline Mesh torus(double large, double small, int around, int across) {
  Mesh mesh{Vertices(around * across, 3), Faces(2 * around * across, 3)};
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * k / across;
      const double r = large + small * std::cos(v);
      const int a = i * across + k, b = (i + 1) % around * across + k;
      const int c = i * across + (k + 1) % across, d = (i + 1) % around * across + (k + 1) % across;
      mesh.vertices.row(a) << r * std::cos(u), r * std::sin(u), small * std::sin(v);
      mesh.faces.row(2 * a) << a, b, d;
      mesh.faces.row(2 * a + 1) << a, d, c;
    }
  }
  return mesh;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Faces keep their numbers.
inline CgalMesh cgal_mesh(const Mesh& mesh) {
  CgalMesh result;
  for (const auto& v : mesh.vertices.rowwise()) result.add_vertex(Kernel::Point_3(v[0], v[1], v[2]));
  for (const auto& f : mesh.faces.rowwise()) {
    result.add_face(CgalMesh::Vertex_index(static_cast<unsigned>(f[0])),
                    CgalMesh::Vertex_index(static_cast<unsigned>(f[1])),
                    CgalMesh::Vertex_index(static_cast<unsigned>(f[2])));
  }
  return result;
}

}  // namespace partwise::test
