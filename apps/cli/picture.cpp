#include "picture.h"

#include <Eigen/Geometry>
#include <span>
#include <utility>

#include "partwise/geometry/topology.h"
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
  for (const PreviewCurve& curve : scene.curves) add(curve.points);
  for (const PreviewPoints& points : scene.points) add(points.points);
  const Point centre = (box.min() / 2 + box.max() / 2).transpose();
  const double half = (box.max() / 2 - box.min() / 2).maxCoeff();
  const double unit = half > 0 ? half : 1;
  const auto move = [&](Vertices& points) { points = (points.rowwise() - centre) / unit; };
  for (PreviewMesh& mesh : scene.meshes) move(mesh.mesh.vertices);
  for (PreviewCurve& curve : scene.curves) {
    move(curve.points);
    curve.radius /= unit;
  }
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

void write_cage_picture(const std::filesystem::path& path, const Mesh& mesh, const Mesh& cage) {
  PreviewScene scene;
  scene.meshes.push_back({.mesh = mesh, .face_colours = {}, .colour = Eigen::Vector3f(0.75f, 0.42f, 0.16f)});
  forget_unused(scene.meshes[0].mesh);
  const double thickness = 0.004 * bounding_sphere(cage).radius;
  for_each_edge(sorted_half_edges(cage), [&](std::span<const HalfEdge> edge) {
    const std::vector<int> ends{edge[0].low, edge[0].high};
    scene.curves.push_back({cage.vertices(ends, Eigen::all), thickness, Eigen::Vector3f(0.05f, 0.12f, 0.3f)});
  });
  write_scene(path, std::move(scene));
}

}  // namespace partwise::cli
