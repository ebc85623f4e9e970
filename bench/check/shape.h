// Triangle meshes, hulls and labels as the judges read them: readers of their own, so that an error in the library's
// readers and writers shows.
//
//   OFF    "OFF", counts, vertices, triangles; comments from # to the end of the line.
//   OBJ    v and f (triangles; i, i/t, i//n and i/t/n; negative numbers count back); `o` starts a new object.
//   labels one whole number a line.
//
// Errors: std::runtime_error with file, line and what is wrong.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <filesystem>
#include <vector>

namespace partwise::bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

struct Shape {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;

  double signed_volume() const;  // of a closed mesh; positive when its faces are counter-clockwise from outside
  bool closed() const;           // every edge is passed as often one way as the other, and there is a face
};

Shape read_shape(const std::filesystem::path& path);                 // by the ending: .off, .obj (all objects as one)
std::vector<Shape> read_objects(const std::filesystem::path& path);  // an OBJ's objects in file order
std::vector<int> read_labels(const std::filesystem::path& path);

void write_objects(const std::filesystem::path& path, const std::vector<Shape>& objects);  // OBJ with 17 digits

}  // namespace partwise::bench
