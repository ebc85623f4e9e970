// Collects the vertices and polygons of a mesh file, in file order, and makes the mesh of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

class MeshBuilder {
 public:
  // `file` is named in messages.
  explicit MeshBuilder(std::string file) : file_(std::move(file)) {}

  // Room for counts that a header claims; the caller makes sure that the file is long enough to hold them.
  void reserve(std::size_t vertices, std::size_t faces);

  void add_vertex(double x, double y, double z) { positions_.insert(positions_.end(), {x, y, z}); }
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(positions_.size() / 3); }

  // A polygon: its corners, then the end of it. Indices must name vertices by the time of build().
  void add_corner(std::int64_t vertex) { corners_.push_back(static_cast<int>(vertex)); }
  void end_face() { ends_.push_back(corners_.size()); }
  // The same, where exporters leave edges and points among the faces: of one or two corners, the last is repeated until
  // the face is a degenerate triangle.
  void end_any_face() {
    while (corners_of_open_face() < 3) corners_.push_back(corners_.back());
    end_face();
  }
  std::size_t corners_of_open_face() const { return corners_.size() - (ends_.empty() ? 0 : ends_.back()); }
  std::size_t face_count() const { return ends_.size(); }

  // Polygons are triangulated in place. Throws InputError for a mesh without faces, for more vertices or corners than
  // an int can count, and for a polygon of more than 10 000 corners, whose ears could take too long.
  Mesh build();

 private:
  std::string file_;
  std::vector<double> positions_;  // x y z a vertex
  std::vector<int> corners_;       // of all faces
  std::vector<std::size_t> ends_;  // of each face in corners_
};

}  // namespace partwise
