#include "partwise/geometry/inner_visibility.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "partwise/base/error.h"
#include "partwise/geometry/ray_scene.h"

namespace partwise {
namespace {

constexpr double kInwards = 1e-4;      // of R
constexpr double kShareOfWall = 0.25;  // at most
constexpr double kOwnFaces = 1e-6;     // of R: nearer hits are the vertex's own faces

using Points = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

}  // namespace

Vertices vertex_normals(const Mesh& mesh) {
  Vertices normals = Vertices::Zero(mesh.vertices.rows(), 3);
  for (const auto& face : mesh.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const Point a = mesh.vertices.row(face[k]);
      const Point ab = Point(mesh.vertices.row(face[(k + 1) % 3])) - a,
                  ac = Point(mesh.vertices.row(face[(k + 2) % 3])) - a;
      const Point across = ab.cross(ac);
      const double length = across.norm();
      if (length > 0) normals.row(face[k]) += std::atan2(length, ab.dot(ac)) / length * across;
    }
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v)
    if (const double length = normals.row(v).norm(); length > 0) normals.row(v) /= length;
  return normals;
}

struct InnerVisibility::Scene {
  RayScene rays;
  Points inner, normals;

  // The first face met from a vertex against its normal, and how far.
  std::pair<int, float> inwards(Eigen::Index vertex, const Points& from, float at_least) const {
    RTCRayHit ray{};
    ray.ray.org_x = from(vertex, 0), ray.ray.org_y = from(vertex, 1), ray.ray.org_z = from(vertex, 2);
    ray.ray.dir_x = -normals(vertex, 0), ray.ray.dir_y = -normals(vertex, 1), ray.ray.dir_z = -normals(vertex, 2);
    ray.ray.tnear = at_least;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rays.scene(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {-1, ray.ray.tfar};
    return {static_cast<int>(ray.hit.primID), ray.ray.tfar};
  }
};

InnerVisibility::InnerVisibility(const Mesh& mesh) {
  const Sphere sphere = bounding_sphere(mesh);
  const Vertices normals = vertex_normals(mesh);
  if (!(sphere.radius > 0) || normals.isZero(0))
    throw InputError("mesh", "no face has an area", "give a mesh with at least one proper triangle");
  const Vertices scaled = (mesh.vertices.rowwise() - sphere.centre) / sphere.radius;
  // NOLINTNEXTLINE(modernize-make-unique): it cannot fill an aggregate that does not move.
  scene_.reset(new Scene{RayScene(scaled, mesh.faces, RTC_SCENE_FLAG_ROBUST), {}, normals.cast<float>()});
  const Points outer = scaled.cast<float>();
  scene_->inner.resize(outer.rows(), 3);
  for (Eigen::Index v = 0; v < outer.rows(); ++v) {
    double shift = 0;
    if (!normals.row(v).isZero(0)) {
      const double wall = scene_->inwards(v, outer, static_cast<float>(kOwnFaces)).second;
      shift = std::min(kInwards, kShareOfWall * wall);
    }
    scene_->inner.row(v) = (scaled.row(v) - shift * normals.row(v)).cast<float>();
  }
}

InnerVisibility::~InnerVisibility() = default;
InnerVisibility::InnerVisibility(InnerVisibility&&) noexcept = default;
InnerVisibility& InnerVisibility::operator=(InnerVisibility&&) noexcept = default;

const Points& InnerVisibility::inner_points() const { return scene_->inner; }

bool InnerVisibility::sees(int p, int q) const {
  if (p > q) std::swap(p, q);  // the same ray, whoever asks
  const Points& at = scene_->inner;
  RTCRay ray{};
  ray.org_x = at(p, 0), ray.org_y = at(p, 1), ray.org_z = at(p, 2);
  ray.dir_x = at(q, 0) - at(p, 0), ray.dir_y = at(q, 1) - at(p, 1), ray.dir_z = at(q, 2) - at(p, 2);
  ray.tnear = 0;
  ray.tfar = 1;
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->rays.scene(), &context, &ray);
  return ray.tfar >= 0;
}

int InnerVisibility::opposite_face(int vertex) const {
  if (scene_->normals.row(vertex).isZero(0)) return -1;
  return scene_->inwards(vertex, scene_->inner, 0).first;
}

}  // namespace partwise
