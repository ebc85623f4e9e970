#include "partwise/motion/world.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "partwise/motion/point_scene.h"
#include "partwise/parts/planar/outline.h"
#include "partwise/parts/planar/planar_hull.h"
#include "partwise/parts/solid/decompose.h"

namespace partwise {
namespace {

template <typename Box>
Box wider(const Box& box, double margin) {
  Box result = box;
  const double by = margin * box.diagonal().norm();
  result.min().array() -= by;
  result.max().array() += by;
  return result;
}

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

World city_world(const City& city, const WorldSettings& settings, const Progress& progress) {
  constexpr double whole_tolerance = 0.1;
  std::vector<Polygons> obstacles;
  std::vector<Ring> hulls;
  std::vector<int> owners;
  double done = 0;
  for (const Polygons& footprint : city.footprints) {
    progress("parts", done++ / static_cast<double>(city.footprints.size()));
    const Outline outline = decompose_outline(footprint, {.tolerance = settings.tolerance.value_or(whole_tolerance)});
    if (!settings.tolerance) obstacles.push_back(footprint);
    for (const Polygon& part : outline.parts) {
      if (settings.tolerance) obstacles.push_back({part});
      hulls.push_back(hull_of(part));
      owners.push_back(static_cast<int>(obstacles.size()) - 1);
    }
  }
  Eigen::AlignedBox2d box;
  for (const Polygons& each : obstacles) box.extend(bounding_box(each));
  World world;
  world.contacts = contact_samples(hulls, owners, settings.contacts);
  world.scene = point_scene(obstacles, wider(box, settings.margin));
  return world;
}

World mesh_world(const Mesh& mesh, const WorldSettings& settings, const Progress& progress) {
  constexpr double usual_tolerance = 0.05;
  const Decomposition parts = decompose(mesh, {.tolerance = settings.tolerance.value_or(usual_tolerance)}, progress);
  std::vector<int> owners;
  Eigen::AlignedBox3d box;
  for (const Mesh& hull : parts.hulls) {
    owners.push_back(static_cast<int>(owners.size()));
    for (const auto& vertex : hull.vertices.rowwise()) box.extend(vertex.transpose());
  }
  World world;
  world.contacts = contact_samples(parts.hulls, owners, settings.contacts);
  world.scene =
      point_scene(part_meshes(parts.mesh, parts.mesh_labels, parts.parts()), parts.mesh, wider(box, settings.margin));
  return world;
}

}  // namespace partwise
