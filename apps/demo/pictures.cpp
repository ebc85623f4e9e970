#include "pictures.h"

#include <algorithm>

#include "partwise/appearance/palette.h"

namespace demo {
namespace {

using partwise::Image;
using partwise::Mesh;
using partwise::Point;
using partwise::PreviewMesh;
using partwise::PreviewScene;

Point middle(const partwise::Vertices& points) {
  return (points.colwise().minCoeff() + points.colwise().maxCoeff()) / 2;
}

Image draw(PreviewScene scene, double azimuth) {
  partwise::PreviewView view;
  view.azimuth = azimuth;
  const partwise::PreviewSettings settings;
  const double aspect = static_cast<double>(settings.width) / settings.height;
  return render_preview(scene, frame_scene(scene, view, aspect), settings);
}

}  // namespace

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

ModelPictures draw_model(const Mesh& mesh, const partwise::Decomposition& parts, double azimuth) {
  ModelPictures pictures;
  PreviewScene scene;
  scene.meshes.push_back({mesh, {}});
  pictures.input = draw(scene, azimuth);
  scene.meshes[0].mesh = parts.mesh;
  for (const int label : parts.mesh_labels) scene.meshes[0].face_colours.push_back(partwise::part_colour(label));
  pictures.parts = draw(scene, azimuth);
  scene.meshes = hull_meshes(parts, 0.3);
  pictures.hulls = draw(scene, azimuth);
  return pictures;
}

Image tile(std::span<const Image> pictures, int columns) {
  const Image& first = pictures[0];
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  Image sheet(columns * first.width, rows * first.height, first.channels);
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    const Image& picture = pictures[static_cast<std::size_t>(i)];
    for (int y = 0; y < first.height; ++y) {
      std::copy_n(picture.pixel(0, y), first.width * first.channels,
                  sheet.pixel(i % columns * first.width, i / columns * first.height + y));
    }
  }
  return sheet;
}

}  // namespace demo
