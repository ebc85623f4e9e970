#include "partwise/parts/surface/shape_diameter.h"

#include <Eigen/Geometry>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/parts/surface/face_values.h"

namespace partwise {
namespace {

constexpr double kOutlier = 1.5;  // median absolute deviations
constexpr double kOffset = 1e-6;  // of the bounding sphere's radius: a ray does not meet the face that it leaves
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Rays about the z axis; not of unit length.
Vertices cone_rays(const ShapeDiameterSettings& settings) {
  const double golden = (3 - std::sqrt(5.0)) * std::numbers::pi;
  const double along = std::cos(settings.cone_angle / 2), aside = std::sin(settings.cone_angle / 2);
  Vertices rays(settings.rays, 3);
  for (int i = 0; i < settings.rays; ++i) {
    const double radius = aside * i / settings.rays;
    rays.row(i) << radius * std::cos(golden * i), radius * std::sin(golden * i), along;
  }
  return rays;
}

// The middle one, or the mean of the middle two. Reorders.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle : (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double mean_without_outliers(std::vector<double>& lengths) {
  if (lengths.empty()) return kMissing;
  const double middle = median(lengths);
  std::vector<double> deviation(lengths.size());
  std::transform(lengths.begin(), lengths.end(), deviation.begin(), [&](double x) { return std::abs(x - middle); });
  const double bound = kOutlier * median(deviation);
  double sum = 0;
  int count = 0;
  for (double length : lengths) {
    if (std::abs(length - middle) > bound) continue;
    sum += length;
    ++count;
  }
  return count > 0 ? sum / count : middle;
}

// Scaled to R = 1, so that areas of meshes of any size can be squared.
Mesh scaled(const Mesh& mesh, const Sphere& sphere) {
  return {(mesh.vertices.rowwise() - sphere.centre) / sphere.radius, mesh.faces};
}

class Thickness {
 public:
  Thickness(const Mesh& mesh, const Sphere& sphere, const ShapeDiameterSettings& settings)
      : radius_(sphere.radius), mesh_(scaled(mesh, sphere)), surface_(mesh_), rays_(cone_rays(settings)) {}

  double of(Eigen::Index face, std::vector<double>& lengths) const {
    const Point inward = -area_vector(face);
    if (!(inward.squaredNorm() > 0)) return kMissing;
    const auto& corners = mesh_.faces.row(face);
    const Point middle =
        (mesh_.vertices.row(corners[0]) + mesh_.vertices.row(corners[1]) + mesh_.vertices.row(corners[2])) / 3;
    const Point axis = inward.normalized();
    const Point side = Point(axis.transpose().unitOrthogonal().transpose()), other = axis.cross(side);
    lengths.clear();
    for (const auto& ray : rays_.rowwise()) {
      const Point direction = (ray[0] * side + ray[1] * other + ray[2] * axis).normalized();
      const auto hit = surface_.first_hit(middle, direction, kOffset);
      if (hit.face >= 0 && area_vector(hit.face).dot(direction) > 0) lengths.push_back(hit.distance * radius_);
    }
    return mean_without_outliers(lengths);
  }

 private:
  Point area_vector(Eigen::Index face) const {
    const Point a = mesh_.vertices.row(mesh_.faces(face, 0));
    return (mesh_.vertices.row(mesh_.faces(face, 1)) - a).cross(mesh_.vertices.row(mesh_.faces(face, 2)) - a);
  }

  double radius_;
  Mesh mesh_;
  SurfaceQuery surface_;
  Vertices rays_;
};

void check(const ShapeDiameterSettings& settings) {
  if (settings.rays < 1)
    throw InputError("rays", fmt::format("{} is no number of rays", settings.rays), "give 1 or more");
  if (!(settings.cone_angle > 0 && settings.cone_angle < std::numbers::pi)) {
    throw InputError("cone_angle", fmt::format("{} is no angle of a cone", settings.cone_angle),
                     "give radians above 0 and below pi");
  }
}

}  // namespace

ShapeDiameter shape_diameter(const Mesh& mesh, const ShapeDiameterSettings& settings, const Progress& progress) {
  check(settings);
  const Thickness thickness(mesh, bounding_sphere(mesh), settings);
  ShapeDiameter result;
  result.values.resize(mesh.faces.rows());
  constexpr Eigen::Index kBatch = 8192;
  for (Eigen::Index begin = 0; begin < mesh.faces.rows(); begin += kBatch) {
    progress("shape diameter", static_cast<double>(begin) / static_cast<double>(mesh.faces.rows()));
    const Eigen::Index end = std::min(begin + kBatch, mesh.faces.rows());
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(begin, end, 256),
                      [&](const tbb::blocked_range<Eigen::Index>& range) {
                        std::vector<double> lengths;
                        for (Eigen::Index f = range.begin(); f < range.end(); ++f)
                          result.values[f] = thickness.of(f, lengths);
                      });
  }
  const FaceAdjacency adjacency = face_adjacency(mesh);
  result.missing = fill_missing(adjacency, result.values);
  const int window = settings.smoothing < 0 ? default_window(mesh.faces.rows()) : settings.smoothing;
  result.values = smooth_bilaterally(adjacency, result.values, window);
  return result;
}

}  // namespace partwise
