#include "partwise/appearance/rendering/g_buffer.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "partwise/appearance/corner_normals.h"
#include "partwise/appearance/rendering/pixel_samples.h"
#include "partwise/base/error.h"
#include "partwise/geometry/ray_scene.h"

namespace partwise {
namespace {

using Vector = Eigen::Vector3f;
constexpr int together = 8;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct CameraRay {
  Eigen::Vector3d origin, direction;  // the direction moves by 1 along the viewing direction
};

// Through (across, down) of the frame, both in [0, 1], from the top left.
CameraRay camera_ray(const Camera& camera, double aspect, double across, double down) {
  const double x = (2 * across - 1) * camera.half_height * aspect, y = (1 - 2 * down) * camera.half_height;
  const Eigen::Vector3d position = camera.position.transpose();
  if (camera.orthographic) {
    return {position + camera.axes.transpose() * Eigen::Vector3d(x, y, 0), -camera.axes.row(2).transpose()};
  }
  return {position, camera.axes.transpose() * Eigen::Vector3d(x, y, -1)};
}

CameraRay sample_ray(const Camera& camera, const RasterSize& size, std::size_t sample) {
  const auto samples = static_cast<std::size_t>(size.samples), width = static_cast<std::size_t>(size.width);
  const Eigen::Vector2d place = sample_place(static_cast<int>(sample % samples), size.samples);
  const std::size_t pixel = sample / samples, row = pixel / width;
  return camera_ray(camera, static_cast<double>(size.width) / size.height,
                    (static_cast<double>(pixel % width) + place.x()) / size.width,
                    (static_cast<double>(row) + place.y()) / size.height);
}

Mesh joined(std::span<const RenderMesh> meshes) {
  Mesh all;
  for (const RenderMesh& each : meshes) {
    const Eigen::Index vertices = all.vertices.rows(), faces = all.faces.rows();
    all.vertices.conservativeResize(vertices + each.mesh.vertices.rows(), 3);
    all.vertices.bottomRows(each.mesh.vertices.rows()) = each.mesh.vertices;
    all.faces.conservativeResize(faces + each.mesh.faces.rows(), 3);
    all.faces.bottomRows(each.mesh.faces.rows()) = each.mesh.faces.array() + static_cast<int>(vertices);
  }
  PARTWISE_CHECK(all.faces.rows(), >, 0);
  return all;
}

// A scene of single precision has its centre at zero and a radius of 1.
struct Unit {
  Eigen::Vector3d centre;
  double scale;

  explicit Unit(const Mesh& mesh) {
    const Sphere ball = bounding_sphere(mesh);
    centre = ball.centre.transpose();
    scale = ball.radius > 0 ? 1 / ball.radius : 1;
  }
  Vector point(const Eigen::Vector3d& p) const { return ((p - centre) * scale).cast<float>(); }
  Vertices points(const Vertices& all) const { return (all.rowwise() - centre.transpose()) * scale; }
};

template <typename Rays>
void set_ray(Rays& rays, int k, const Vector& origin, const Vector& direction) {
  rays.org_x[k] = origin.x(), rays.org_y[k] = origin.y(), rays.org_z[k] = origin.z();
  rays.dir_x[k] = direction.x(), rays.dir_y[k] = direction.y(), rays.dir_z[k] = direction.z();
  rays.tnear[k] = 0, rays.tfar[k] = infinity, rays.mask[k] = ~0u;
}

}  // namespace

struct RenderScene::Rays {
  Mesh mesh;
  std::vector<int> part_of_face;
  int parts = 0;
  Unit unit;
  RayScene scene;
  CornerNormals normals;

  explicit Rays(std::span<const RenderMesh> meshes)
      : mesh(joined(meshes)),
        unit(mesh),
        scene(unit.points(mesh.vertices), mesh.faces, RTC_SCENE_FLAG_ROBUST),
        normals(3 * mesh.faces.rows(), 3) {
    Eigen::Index row = 0;
    for (const RenderMesh& each : meshes) {
      const Eigen::Index faces = each.mesh.faces.rows();
      normals.middleRows(row, 3 * faces) = corner_normals(each.mesh, each.crease_degrees);
      row += 3 * faces;
      if (!each.parts.empty()) PARTWISE_CHECK(static_cast<Eigen::Index>(each.parts.size()), ==, faces);
      for (Eigen::Index f = 0; f < faces; ++f) {
        const int part = each.parts.empty() ? 0 : each.parts[static_cast<std::size_t>(f)];
        PARTWISE_CHECK(part, >=, 0);
        part_of_face.push_back(part);
        parts = std::max(parts, part + 1);
      }
    }
  }

  // The flat normal that Embree gives, turned to the viewer, or what the corners make of it.
  Vector normal(Vector flat, unsigned face, float u, float v, const Vector& direction) const {
    flat.normalize();
    if (flat.dot(direction) > 0) flat = -flat;
    const std::array<float, 3> weights{1 - u - v, u, v};
    Vector sum = Vector::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector corner = normals.row(3 * static_cast<Eigen::Index>(face) + k);
      sum += (corner.dot(flat) < 0 ? -weights[static_cast<std::size_t>(k)] : weights[static_cast<std::size_t>(k)]) *
             corner;
    }
    const float length = sum.norm();
    return length > 1e-3f ? Vector(sum / length) : flat;
  }
};

Eigen::Vector3d seen_point(const GBuffer& seen, const Camera& camera, std::size_t sample) {
  const CameraRay ray = sample_ray(camera, seen.size, sample);
  return ray.origin + static_cast<double>(seen.depths[sample]) * ray.direction;
}

RenderScene::RenderScene(std::span<const RenderMesh> meshes) : rays_(std::make_unique<Rays>(meshes)) {}
RenderScene::~RenderScene() = default;
RenderScene::RenderScene(RenderScene&&) noexcept = default;
RenderScene& RenderScene::operator=(RenderScene&&) noexcept = default;

int RenderScene::parts() const { return rays_->parts; }
const Vertices& RenderScene::vertices() const { return rays_->mesh.vertices; }

GBuffer RenderScene::view(const Camera& camera, const RasterSize& size) const {
  PARTWISE_CHECK(size.width, >=, 1);
  PARTWISE_CHECK(size.height, >=, 1);
  PARTWISE_CHECK(size.samples, >=, 1);
  const auto row = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.samples);
  const std::size_t count = row * static_cast<std::size_t>(size.height);
  GBuffer seen{size, std::vector<Vector>(count, Vector::Zero()), std::vector<float>(count, 0.0f),
               std::vector<int>(count, -1)};
  const Rays& rays = *rays_;
  const Eigen::Matrix3f to_camera = camera.axes.cast<float>();
  const auto trace = [&](std::size_t first, std::size_t end) {  // at most eight samples
    alignas(32) RTCRayHit8 packet{};
    alignas(32) std::array<int, together> valid{};
    for (std::size_t i = first; i < end; ++i) {
      const CameraRay ray = sample_ray(camera, size, i);
      const int k = static_cast<int>(i - first);
      set_ray(packet.ray, k, rays.unit.point(ray.origin), (ray.direction * rays.unit.scale).cast<float>());
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      valid[static_cast<std::size_t>(k)] = -1;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid.data(), rays.scene.scene(), &context, &packet);
    for (std::size_t i = first; i < end; ++i) {
      const auto k = i - first;
      if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
      const unsigned face = packet.hit.primID[k];
      const Vector direction(packet.ray.dir_x[k], packet.ray.dir_y[k], packet.ray.dir_z[k]);
      const Vector flat(packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]);
      seen.normals[i] = (to_camera * rays.normal(flat, face, packet.hit.u[k], packet.hit.v[k], direction)).normalized();
      seen.depths[i] = packet.ray.tfar[k];  // directions move by 1 along the view
      seen.parts[i] = rays.part_of_face[face];
    }
  };
  tbb::parallel_for(0, size.height, [&](int y) {
    const std::size_t begin = static_cast<std::size_t>(y) * row;
    for (std::size_t i = begin; i < begin + row; i += together) trace(i, std::min(i + together, begin + row));
  });
  return seen;
}

void RenderScene::lit(const Camera& camera, const GBuffer& seen, std::size_t sample, const LightSamples& light,
                      Eigen::ArrayXf& visible) const {
  constexpr float lift = 1e-4f;  // of the scene's radius, off the surface
  const Rays& rays = *rays_;
  const Eigen::Matrix3f to_scene = camera.axes.transpose().cast<float>();
  const Vector normal = to_scene * seen.normals[sample];
  const Vector point = rays.unit.point(seen_point(seen, camera, sample)) + lift * normal;
  visible.setZero(light.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (Eigen::Index i = 0; i < light.size(); i += together) {
    alignas(32) RTCRay8 packet{};
    alignas(32) std::array<int, together> valid{};
    bool asked = false;
    for (int k = 0; k < together; ++k) {
      const Vector direction = light.direction(i + k);
      if (!(direction.dot(seen.normals[sample]) > 0)) continue;
      set_ray(packet, k, point, to_scene * direction);
      valid[static_cast<std::size_t>(k)] = -1;
      asked = true;
    }
    if (!asked) continue;
    rtcOccluded8(valid.data(), rays.scene.scene(), &context, &packet);
    for (int k = 0; k < together; ++k) {
      if (valid[static_cast<std::size_t>(k)] != 0 && packet.tfar[k] >= 0) visible[i + k] = 1;
    }
  }
}

Camera frame_share(const RenderScene& scene, const ShareView& view, double width_over_height) {
  PARTWISE_CHECK(view.share, >, 0);
  PARTWISE_CHECK(view.share, <, 1);
  constexpr double most = 0.96;  // of the width or height
  constexpr int probe = 96, steps = 4;
  const RoundPoints points{&scene.vertices(), 0};
  CameraView frame{view.azimuth, view.elevation, view.field_of_view, most};
  Camera camera;
  for (int step = 0; step < steps; ++step) {
    camera = frame_points({&points, 1}, frame, width_over_height);
    const int width = std::max(1, static_cast<int>(std::lround(probe * width_over_height)));
    const double covered = scene.view(camera, {width, probe, 1}).foreground();
    if (covered <= 0) break;
    const double fill = std::min(most, frame.fill * std::sqrt(view.share / covered));
    if (std::abs(fill - frame.fill) < 1e-3) break;
    frame.fill = fill;
  }
  return frame_points({&points, 1}, frame, width_over_height);
}

}  // namespace partwise
