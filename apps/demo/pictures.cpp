#include "pictures.h"

#include <algorithm>
#include <numeric>

#include "partwise/appearance/colouring.h"
#include "partwise/appearance/palette.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace demo {
namespace {

using partwise::Image;
using partwise::Mesh;
using partwise::Point;
using partwise::PreviewMesh;
using partwise::PreviewScene;

// Without a deep valley (rims, which run on the hull, do not count) the hull vertices are one ridge.
std::vector<std::vector<int>> ridges_of(const partwise::PartGraph& part, const partwise::Bridges& bridges) {
  std::vector<std::vector<int>> ridges = partwise::convex_ridges(part, bridges).members;
  if (!bridges.deep.empty()) return ridges;
  for (std::size_t i = 1; i < ridges.size(); ++i) ridges[0].insert(ridges[0].end(), ridges[i].begin(), ridges[i].end());
  ridges.resize(std::min<std::size_t>(ridges.size(), 1));
  return ridges;
}

// The input with its deep valleys as dark lines and the hull vertices of each convex ridge as beads of one colour.
Image draw_ridges(const Mesh& mesh, const partwise::Decomposition& parts, double azimuth, ModelPictures& pictures) {
  PreviewScene scene;
  scene.meshes.push_back({mesh, {}});
  const partwise::SurfaceQuery surface(partwise::orient_consistently(mesh));
  std::vector<int> faces(static_cast<std::size_t>(mesh.faces.rows()));
  std::iota(faces.begin(), faces.end(), 0);
  for (const std::vector<int>& group : partwise::connected_groups(mesh, faces)) {
    const partwise::PartGraph part = partwise::part_graph(mesh, group);
    const double tolerance = parts.tolerance * parts.radius;
    const partwise::Bridges bridges = find_bridges(part, part_hull(part, tolerance), surface, tolerance);
    const auto positions = [&](const std::vector<int>& vertices) -> partwise::Vertices {
      return part.positions(vertices, Eigen::all);
    };
    for (const partwise::Valley& valley : bridges.deep) {
      if (valley.path.size() < 2) continue;
      scene.curves.push_back({positions(valley.path), 0.0045 * parts.radius, {0.03f, 0.035f, 0.05f}});
      ++pictures.valley_count;
    }
    for (const std::vector<int>& ridge : ridges_of(part, bridges)) {
      scene.points.push_back({positions(ridge), 0.014 * parts.radius, partwise::part_colour(pictures.ridge_count++)});
    }
  }
  return draw(scene, azimuth);
}

}  // namespace

Point middle(const partwise::Vertices& points) {
  return (points.colwise().minCoeff() + points.colwise().maxCoeff()) / 2;
}

std::vector<PreviewMesh> hull_meshes(const partwise::Decomposition& parts, double apart) {
  const Point centre = middle(parts.mesh.vertices);
  std::vector<PreviewMesh> meshes;
  for (const Mesh& hull : parts.hulls) {
    PreviewMesh moved{hull, {}, partwise::part_colour(static_cast<int>(meshes.size())), 20};
    // Hulls of neighbours share planes. Each is drawn a hair smaller than the one before, so that one of them is in
    // front.
    const Point own = middle(hull.vertices);
    const double shrink = 1 - 3e-4 * static_cast<double>(1 + meshes.size() % 16);
    moved.mesh.vertices = (hull.vertices.rowwise() - own) * shrink;
    moved.mesh.vertices.rowwise() += own + apart * (own - centre);
    meshes.push_back(std::move(moved));
  }
  return meshes;
}

Image draw(const PreviewScene& scene, double azimuth, const partwise::PreviewSettings& settings) {
  partwise::PreviewView view;
  view.azimuth = azimuth;
  const double aspect = static_cast<double>(settings.width) / settings.height;
  return render_preview(scene, frame_scene(scene, view, aspect), settings);
}

ModelPictures draw_model(const Mesh& mesh, const partwise::Decomposition& parts, double azimuth) {
  ModelPictures pictures;
  PreviewScene scene;
  scene.meshes.push_back({mesh, {}});
  pictures.input = draw(scene, azimuth);
  pictures.ridges = draw_ridges(mesh, parts, azimuth, pictures);
  scene.meshes[0] = coloured_by_part(parts.mesh, parts.mesh_labels);
  pictures.parts = draw(scene, azimuth);
  scene.meshes = hull_meshes(parts, 0.3);
  pictures.hulls = draw(scene, azimuth);
  return pictures;
}

}  // namespace demo
