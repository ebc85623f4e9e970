#include "partwise/parts/solid/convex_solid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

// Of the vertices that faces use, each once.
std::vector<int> used_vertices(const Mesh& mesh) {
  std::vector<int> used(mesh.faces.reshaped().begin(), mesh.faces.reshaped().end());
  std::ranges::sort(used);
  const auto repeated = std::ranges::unique(used);
  used.erase(repeated.begin(), repeated.end());
  return used;
}

// Of a mesh of radius 1.
bool lies_below_all_faces(const Vertices& points, const Mesh& mesh) {
  constexpr double rounding = 1e-12;
  return std::ranges::all_of(mesh.faces.rowwise(), [&](const auto& face) {
    const Point a = mesh.vertices.row(face[0]);
    const Point normal = (mesh.vertices.row(face[1]) - a).cross(mesh.vertices.row(face[2]) - a);
    return ((points.rowwise() - a) * normal.transpose()).maxCoeff() <= rounding * normal.norm();
  });
}

}  // namespace

std::optional<Mesh> convex_solid(const Mesh& mesh, const Sphere& bounds, double minimum_thickness) {
  constexpr double most_products = 1e7;
  const std::vector<int> used = used_vertices(mesh);
  if (static_cast<double>(mesh.faces.rows()) * static_cast<double>(used.size()) > most_products) return std::nullopt;
  if (!is_watertight(mesh) || face_components_by_vertex(mesh).count != 1) return std::nullopt;
  const Mesh scaled{(mesh.vertices.rowwise() - bounds.centre) / bounds.radius, mesh.faces};
  const Vertices points = scaled.vertices(used, Eigen::all);
  if (!lies_below_all_faces(points, scaled)) return std::nullopt;
  ConvexHull hull = convex_hull(points, minimum_thickness);
  if (hull.thickened) return std::nullopt;
  for (std::size_t i = 0; i < hull.source.size(); ++i)
    hull.mesh.vertices.row(static_cast<Eigen::Index>(i)) =
        mesh.vertices.row(used[static_cast<std::size_t>(hull.source[i])]);
  return std::move(hull.mesh);
}

}  // namespace partwise
