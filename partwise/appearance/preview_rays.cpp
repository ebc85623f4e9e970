#include "partwise/appearance/preview_rays.h"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "partwise/appearance/corner_normals.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

using Vector = Eigen::Vector3f;

RTCRay make_ray(const Vector& origin, const Vector& direction) {
  RTCRay ray{};
  ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

}  // namespace

PreviewRays::PreviewRays(const PreviewScene& scene)
    : device_(rtcNewDevice(nullptr)),
      scene_(rtcNewScene(device_.get())),
      low_(Vector::Constant(std::numeric_limits<float>::infinity())),
      high_(-low_) {
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  for (const PreviewMesh& mesh : scene.meshes) add(mesh);
  for (const PreviewCurve& curve : scene.curves) add_round(curve.points, curve.radius, curve.colour, true);
  for (const PreviewPoints& points : scene.points) add_round(points.points, points.radius, points.colour, false);
  PARTWISE_CHECK(size(), >=, 0);
  // One thread builds one tree: where surfaces coincide, which of them is hit depends on the tree.
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene_.get()); });
}

void PreviewRays::add(const PreviewMesh& preview) {
  const Mesh& mesh = preview.mesh;
  if (mesh.faces.rows() == 0) return;
  Body body{preview.face_colours, static_cast<int>(surfaces_.size())};
  if (body.colours.empty())
    body.colours.push_back(preview.colour);
  else
    PARTWISE_CHECK(static_cast<Eigen::Index>(body.colours.size()), ==, mesh.faces.rows());
  surfaces_.push_back({mesh.vertices.cast<float>(), corner_normals(mesh, preview.crease_degrees)});
  faces_.push_back(mesh.faces);
  const Surface& surface = surfaces_.back();
  low_ = low_.cwiseMin(surface.vertices.colwise().minCoeff().transpose());
  high_ = high_.cwiseMax(surface.vertices.colwise().maxCoeff().transpose());

  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           static_cast<std::size_t>(mesh.vertices.rows()));
  void* faces = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                        static_cast<std::size_t>(mesh.faces.rows()));
  std::copy_n(surface.vertices.data(), surface.vertices.size(), static_cast<float*>(vertices));
  std::copy_n(mesh.faces.data(), mesh.faces.size(), static_cast<unsigned*>(faces));
  add_body(geometry, std::move(body));
}

void PreviewRays::add_round(const Vertices& points, double radius, const Vector& colour, bool joined) {
  PARTWISE_CHECK(radius, >, 0);
  PARTWISE_CHECK(points.rows(), >=, joined ? 2 : 1);
  RTCGeometry geometry =
      rtcNewGeometry(device_.get(), joined ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* spheres =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                  4 * sizeof(float), static_cast<std::size_t>(points.rows())));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vector p = points.row(i).transpose().cast<float>();
    const float r = static_cast<float>(radius);
    std::copy_n(p.data(), 3, spheres + 4 * i);
    spheres[4 * i + 3] = r;
    low_ = low_.cwiseMin(p - Vector::Constant(r));
    high_ = high_.cwiseMax(p + Vector::Constant(r));
  }
  if (joined) {
    auto* starts =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                                       sizeof(unsigned), static_cast<std::size_t>(points.rows() - 1)));
    for (unsigned i = 0; i + 1 < points.rows(); ++i) starts[i] = i;
  }
  add_body(geometry, {{colour}, -1});
}

void PreviewRays::add_body(RTCGeometry geometry, Body body) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(bodies_.size()));
  rtcReleaseGeometry(geometry);
  bodies_.push_back(std::move(body));
}

bool PreviewRays::first_hit(const Vector& origin, const Vector& direction, PreviewHit& hit) const {
  RTCRayHit ray{make_ray(origin, direction), {}};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const Body& body = bodies_[ray.hit.geomID];
  hit.colour = body.colours[body.colours.size() == 1 ? 0 : ray.hit.primID];
  hit.position = origin + ray.ray.tfar * direction;
  Vector flat = Vector(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized();
  if (flat.dot(direction) > 0) flat = -flat;
  hit.normal = flat;
  if (body.surface >= 0) smooth_hit(surfaces_[static_cast<std::size_t>(body.surface)], ray, flat, hit);
  hit.position += 2e-5f * size() * flat;
  return true;
}

// The normal is interpolated between the corners, and the point is lifted to the curved surface that these normals
// stand for, so that coarse meshes do not shade themselves in facets (Hanika 2021).
void PreviewRays::smooth_hit(const Surface& surface, const RTCRayHit& ray, const Vector& flat, PreviewHit& hit) const {
  const Faces& faces = faces_[static_cast<std::size_t>(&surface - surfaces_.data())];
  const Eigen::Index face = ray.hit.primID;
  const std::array<float, 3> weights{1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v};
  Vector normal = Vector::Zero(), lifted = Vector::Zero();
  for (int k = 0; k < 3; ++k) {
    Vector corner_normal = surface.corner_normals.row(3 * face + k);
    if (corner_normal.dot(flat) < 0) corner_normal = -corner_normal;
    const Vector offset = hit.position - Vector(surface.vertices.row(faces(face, k)));
    const float weight = weights[static_cast<std::size_t>(k)];
    normal += weight * corner_normal;
    lifted -= weight * std::min(0.0f, offset.dot(corner_normal)) * corner_normal;
  }
  hit.normal = normal.norm() > 0 ? Vector(normal.normalized()) : flat;
  hit.position += lifted;
}

bool PreviewRays::blocked(const Vector& origin, const Vector& direction) const {
  RTCRay ray = make_ray(origin, direction);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0;
}

std::array<bool, 4> PreviewRays::blocked(const Vector& origin, const Eigen::Matrix<float, 3, 4>& directions) const {
  alignas(16) RTCRay4 rays{};
  alignas(16) const int valid[4] = {-1, -1, -1, -1};
  for (int i = 0; i < 4; ++i) {
    rays.org_x[i] = origin.x(), rays.org_y[i] = origin.y(), rays.org_z[i] = origin.z();
    rays.dir_x[i] = directions(0, i), rays.dir_y[i] = directions(1, i), rays.dir_z[i] = directions(2, i);
    rays.tfar[i] = std::numeric_limits<float>::infinity();
    rays.mask[i] = ~0u;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded4(valid, scene_.get(), &context, &rays);
  return {rays.tfar[0] < 0, rays.tfar[1] < 0, rays.tfar[2] < 0, rays.tfar[3] < 0};
}

}  // namespace partwise
