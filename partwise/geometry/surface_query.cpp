#include "partwise/geometry/surface_query.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "partwise/base/error.h"
#include "partwise/geometry/closest_point.h"
#include "partwise/geometry/ray_scene.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr int kOpenDirections = 24;

// Directions spread evenly over the sphere (a Fibonacci lattice), none parallel to an axis.
std::array<Eigen::Vector3f, kOpenDirections> directions() {
  std::array<Eigen::Vector3f, kOpenDirections> all;
  for (int i = 0; i < kOpenDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kOpenDirections, around = 2.399963229728653 * i + 0.37;
    const double r = std::sqrt(1 - z * z);
    all[static_cast<std::size_t>(i)] = Eigen::Vector3d(r * std::cos(around), r * std::sin(around), z).cast<float>();
  }
  return all;
}

}  // namespace

struct SurfaceQuery::Scene {
  std::unique_ptr<RayScene> rays;
  Vertices vertices;  // centred and scaled to about [-1, 1]
  Faces faces;
  Point centre;
  double scale = 1;  // model units a unit of the scene
  bool is_closed = false;
  std::array<Eigen::Vector3f, kOpenDirections> directions;
};

SurfaceQuery::SurfaceQuery(const Mesh& mesh) : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  bool any_area = false;
  for (Eigen::Index f = 0; f < mesh.faces.rows() && !any_area; ++f) {
    const Point a = mesh.vertices.row(mesh.faces(f, 0));
    any_area =
        (mesh.vertices.row(mesh.faces(f, 1)) - a).cross(mesh.vertices.row(mesh.faces(f, 2)) - a).squaredNorm() > 0;
  }
  if (!any_area) throw InputError("mesh", "no face has an area", "give a mesh with at least one proper triangle");
  s.faces = mesh.faces;
  s.is_closed = is_watertight(mesh);
  const Sphere sphere = bounding_sphere(mesh);
  s.centre = sphere.centre;
  s.scale = sphere.radius;
  s.vertices = (mesh.vertices.rowwise() - s.centre) / s.scale;
  s.directions = directions();

  s.rays =
      std::make_unique<RayScene>(s.vertices, s.faces, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
}

SurfaceQuery::~SurfaceQuery() = default;
SurfaceQuery::SurfaceQuery(SurfaceQuery&&) noexcept = default;
SurfaceQuery& SurfaceQuery::operator=(SurfaceQuery&&) noexcept = default;

double SurfaceQuery::distance(const Point& p, double at_most) const {
  struct Nearest {
    const Scene* scene;
    Point p;
    double squared;
  };
  const Scene& s = *scene_;
  Nearest nearest{&s, (p - s.centre) / s.scale, 0};
  const double limit = std::min(at_most / s.scale, 1e15);
  nearest.squared = limit * limit;
  RTCPointQuery query;
  query.x = static_cast<float>(nearest.p.x());
  query.y = static_cast<float>(nearest.p.y());
  query.z = static_cast<float>(nearest.p.z());
  query.time = 0;
  // Wider than the exact distance by what rounding to float can take away.
  query.radius = static_cast<float>(limit) * 1.000001f + 1e-6f;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(
      s.rays->scene(), &query, &context,
      [](RTCPointQueryFunctionArguments* args) {
        Nearest& best = *static_cast<Nearest*>(args->userPtr);
        const auto face = best.scene->faces.row(args->primID);
        const Vertices& v = best.scene->vertices;
        const double squared =
            offset_from_triangle(best.p, v.row(face[0]), v.row(face[1]), v.row(face[2])).squaredNorm();
        if (squared >= best.squared) return false;
        best.squared = squared;
        args->query->radius = static_cast<float>(std::sqrt(squared)) * 1.000001f + 1e-6f;
        return true;
      },
      &nearest);
  return std::min(at_most, std::sqrt(nearest.squared) * s.scale);
}

SurfaceQuery::Hit SurfaceQuery::first_hit(const Point& p, const Point& direction, double from) const {
  const Scene& s = *scene_;
  const Eigen::Vector3f origin = ((p - s.centre) / s.scale).cast<float>().transpose();
  const Eigen::Vector3f along = direction.normalized().cast<float>().transpose();
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
  query.ray.dir_x = along.x(), query.ray.dir_y = along.y(), query.ray.dir_z = along.z();
  query.ray.tnear = static_cast<float>(from / s.scale), query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xffffffffu, query.ray.flags = 0, query.ray.time = 0, query.ray.id = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(s.rays->scene(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {static_cast<int>(query.hit.primID), static_cast<double>(query.ray.tfar) * s.scale};
}

double SurfaceQuery::winding_number(const Point& p) const {
  struct Crossings {
    RTCIntersectContext context;  // first, so that the filter finds the whole from it
    int sum = 0;
  };
  const Scene& s = *scene_;
  const Eigen::Vector3f origin = ((p - s.centre) / s.scale).cast<float>().transpose();
  const auto count = [&](const Eigen::Vector3f& direction) {
    Crossings crossings;
    rtcInitIntersectContext(&crossings.context);
    crossings.context.filter = [](const RTCFilterFunctionNArguments* args) {
      const RTCHit* hit = reinterpret_cast<const RTCHit*>(args->hit);
      const RTCRay* ray = reinterpret_cast<const RTCRay*>(args->ray);
      const float along = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
      auto* all = reinterpret_cast<Crossings*>(args->context);
      all->sum += along > 0 ? 1 : along < 0 ? -1 : 0;
      args->valid[0] = 0;  // Go on to the next face.
    };
    RTCRay ray;
    ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tnear = 0, ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = 0xffffffffu, ray.flags = 0, ray.time = 0, ray.id = 0;
    rtcOccluded1(s.rays->scene(), &crossings.context, &ray);
    return crossings.sum;
  };
  if (s.is_closed) {
    const int a = count(s.directions[3]), b = count(s.directions[11]);
    if (a == b) return a;
    const int c = count(s.directions[18]);
    return c == a || c == b ? c : std::max(std::min(a, b), std::min(std::max(a, b), c));  // the median
  }
  double sum = 0;
  for (const auto& direction : s.directions) sum += std::clamp(count(direction), -1, 1);
  return sum / kOpenDirections;
}

}  // namespace partwise
