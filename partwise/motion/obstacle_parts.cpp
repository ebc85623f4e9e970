#include "partwise/motion/obstacle_parts.h"

#include <utility>

#include "partwise/parts/planar/outline.h"
#include "partwise/parts/planar/planar_hull.h"
#include "partwise/parts/solid/decompose.h"

namespace partwise {
namespace {

Ring hull_of(const Polygon& polygon) {
  const std::vector<Eigen::Vector2d> corners(polygon.outer.rowwise().begin(), polygon.outer.rowwise().end());
  return polygon.outer(planar_hull(corners), Eigen::all);
}

// Faces by label, each part with vertices of its own.
std::vector<Mesh> part_meshes(const Mesh& mesh, const std::vector<int>& labels, int parts) {
  std::vector<Mesh> result(static_cast<std::size_t>(parts));
  std::vector<std::vector<Eigen::Index>> faces(result.size());
  for (std::size_t f = 0; f < labels.size(); ++f)
    faces[static_cast<std::size_t>(labels[f])].push_back(static_cast<Eigen::Index>(f));
  for (std::size_t part = 0; part < result.size(); ++part) {
    const auto count = static_cast<Eigen::Index>(faces[part].size());
    result[part].vertices.resize(3 * count, 3);
    result[part].faces.resize(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        result[part].vertices.row(3 * i + k) =
            mesh.vertices.row(mesh.faces(faces[part][static_cast<std::size_t>(i)], k));
        result[part].faces(i, k) = static_cast<int>(3 * i + k);
      }
    }
  }
  return result;
}

}  // namespace

PlanarParts planar_parts(const std::vector<Polygons>& footprints, double tolerance, bool whole,
                         const Progress& progress) {
  PlanarParts result;
  double done = 0;
  for (const Polygons& footprint : footprints) {
    progress("parts", done++ / static_cast<double>(footprints.size()));
    if (whole) result.obstacles.push_back(footprint);
    for (const Polygon& part : decompose_outline(footprint, {.tolerance = tolerance}).parts) {
      if (!whole) result.obstacles.push_back({part});
      result.hulls.push_back(hull_of(part));
      result.owners.push_back(static_cast<int>(result.obstacles.size()) - 1);
    }
  }
  return result;
}

SolidParts solid_parts(const std::vector<Mesh>& meshes, double tolerance, bool whole, const Progress& progress) {
  SolidParts result;
  std::vector<Mesh> solids;
  for (const Mesh& mesh : meshes) {
    const Decomposition parts = decompose(mesh, {.tolerance = tolerance}, progress);
    const auto before = static_cast<int>(result.obstacles.size());
    if (whole)
      result.obstacles.push_back(mesh);
    else
      for (Mesh& part : part_meshes(parts.mesh, parts.mesh_labels, parts.parts()))
        result.obstacles.push_back(std::move(part));
    for (int part = 0; part < parts.parts(); ++part) {
      result.hulls.push_back(parts.hulls[static_cast<std::size_t>(part)]);
      result.owners.push_back(whole ? before : before + part);
    }
    solids.push_back(whole ? mesh : parts.mesh);
  }
  result.solid = joined(solids);
  return result;
}

Mesh joined(const std::vector<Mesh>& meshes) {
  Eigen::Index vertices = 0, faces = 0;
  for (const Mesh& mesh : meshes) {
    vertices += mesh.vertices.rows();
    faces += mesh.faces.rows();
  }
  Mesh all{Vertices(vertices, 3), Faces(faces, 3)};
  vertices = faces = 0;
  for (const Mesh& mesh : meshes) {
    all.vertices.middleRows(vertices, mesh.vertices.rows()) = mesh.vertices;
    all.faces.middleRows(faces, mesh.faces.rows()) = mesh.faces.array() + static_cast<int>(vertices);
    vertices += mesh.vertices.rows();
    faces += mesh.faces.rows();
  }
  return all;
}

}  // namespace partwise
