#include "partwise/geometry/mesh_builder.h"

#include <array>
#include <limits>
#include <span>

#include "partwise/base/error.h"
#include "partwise/geometry/triangulate_polygon.h"

namespace partwise {
namespace {

constexpr std::size_t kMostCorners = 10000;

}  // namespace

void MeshBuilder::reserve(std::size_t vertices, std::size_t faces) {
  positions_.reserve(3 * vertices);
  corners_.reserve(3 * faces);
  ends_.reserve(faces);
}

Mesh MeshBuilder::build() {
  if (ends_.empty()) {
    throw InputError(file_,
                     positions_.empty() ? std::string("holds no faces")
                                        : fmt::format("holds {} vertices and no faces", vertex_count()),
                     "give a surface mesh; points alone need surface reconstruction first");
  }
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (positions_.size() / 3 > kMost || corners_.size() > kMost) {
    throw InputError(file_, "holds more vertices or corners than an int counts", "split it into several files");
  }
  Mesh mesh;
  mesh.vertices = Eigen::Map<const Vertices>(positions_.data(), vertex_count(), 3);
  std::vector<double>().swap(positions_);
  if (corners_.size() == 3 * ends_.size()) {  // Every face has at least three corners: all are triangles.
    mesh.faces = Eigen::Map<const Faces>(corners_.data(), static_cast<Eigen::Index>(ends_.size()), 3);
    return mesh;
  }
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(corners_.size() - 2 * ends_.size());
  std::size_t first = 0;
  for (std::size_t face = 0; face < ends_.size(); ++face) {
    const std::span<const int> polygon(corners_.data() + first, ends_[face] - first);
    if (polygon.size() > kMostCorners) {
      throw InputError(
          file_,
          fmt::format("face {} has {} corners, at most {} can be triangulated", face, polygon.size(), kMostCorners),
          "export the mesh as triangles");
    }
    triangulate_polygon(mesh.vertices, polygon, triangles);
    first = ends_[face];
  }
  mesh.faces = Eigen::Map<const Faces>(triangles.data()->data(), static_cast<Eigen::Index>(triangles.size()), 3);
  return mesh;
}

}  // namespace partwise
