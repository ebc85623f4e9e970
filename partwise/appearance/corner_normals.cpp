#include "partwise/appearance/corner_normals.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

namespace partwise {

CornerNormals corner_normals(const Mesh& mesh, double crease_degrees) {
  const Eigen::Index faces = mesh.faces.rows();
  Vertices area(faces, 3), unit(faces, 3);
  std::vector<std::vector<Eigen::Index>> around(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index f = 0; f < faces; ++f) {
    const Point a = mesh.vertices.row(mesh.faces(f, 0));
    area.row(f) = Point(mesh.vertices.row(mesh.faces(f, 1)) - a).cross(Point(mesh.vertices.row(mesh.faces(f, 2)) - a));
    unit.row(f) = area.row(f).stableNormalized();
    for (int k = 0; k < 3; ++k) around[static_cast<std::size_t>(mesh.faces(f, k))].push_back(f);
  }
  const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  CornerNormals normals(3 * faces, 3);
  for (Eigen::Index f = 0; f < faces; ++f) {
    for (int k = 0; k < 3; ++k) {
      Point sum = area.row(f);
      for (const Eigen::Index g : around[static_cast<std::size_t>(mesh.faces(f, k))]) {
        if (g != f && unit.row(f).dot(unit.row(g)) > least_cosine) sum += area.row(g);
      }
      normals.row(3 * f + k) = sum.stableNormalized().cast<float>();
    }
  }
  return normals;
}

}  // namespace partwise
