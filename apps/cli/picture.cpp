#include "picture.h"

#include <Eigen/Geometry>
#include <utility>

#include "partwise/imaging/png.h"

namespace partwise::cli {
namespace {

constexpr PreviewSettings picture{.width = 960, .height = 800};

// Vertices without a face are not seen, so the frame need not hold them.
void forget_unused(Mesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.vertices.rows()));
  for (const int vertex : mesh.faces.reshaped()) used[static_cast<std::size_t>(vertex)] = true;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) mesh.vertices.row(v) = mesh.vertices.row(mesh.faces(0, 0));
  }
}

// Rays have single precision, which a small model far from the origin would use up: everything moves to the origin and
// shrinks to about one unit. Halves are summed because the sum of two coordinates may have no number.
void bring_near(PreviewScene& scene) {
  Eigen::AlignedBox3d box;
  const auto add = [&](const Vertices& points) {
    for (const auto& point : points.rowwise()) box.extend(point.transpose());
  };
  for (const PreviewMesh& mesh : scene.meshes) add(mesh.mesh.vertices);
  for (const PreviewPoints& points : scene.points) add(points.points);
  const Point centre = (box.min() / 2 + box.max() / 2).transpose();
  const double half = (box.max() / 2 - box.min() / 2).maxCoeff();
  const double unit = half > 0 ? half : 1;
  const auto move = [&](Vertices& points) { points = (points.rowwise() - centre) / unit; };
  for (PreviewMesh& mesh : scene.meshes) move(mesh.mesh.vertices);
  for (PreviewPoints& points : scene.points) {
    move(points.points);
    points.radius /= unit;
  }
}

void write_scene(const std::filesystem::path& path, PreviewScene scene) {
  bring_near(scene);
  const PreviewCamera camera = frame_scene(scene, {}, static_cast<double>(picture.width) / picture.height);
  write_png(path, render_preview(scene, camera, picture));
}

}  // namespace

void write_picture(const std::filesystem::path& path, PreviewMesh mesh) {
  forget_unused(mesh.mesh);
  PreviewScene scene;
  scene.meshes.push_back(std::move(mesh));
  write_scene(path, std::move(scene));
}

void write_picture(const std::filesystem::path& path, std::vector<PreviewPoints> points) {
  if (points.empty()) {
    write_png(path, Image(picture.width, picture.height, 4));
    return;
  }
  PreviewScene scene;
  scene.points = std::move(points);
  scene.ground = false;
  write_scene(path, std::move(scene));
}

}  // namespace partwise::cli
