#include "partwise/parts/surface/segmentation.h"

#include <chrono>
#include <utility>

#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/face_clustering.h"
#include "partwise/parts/surface/face_values.h"
#include "partwise/parts/surface/shape_diameter.h"

namespace partwise {
namespace {

// A fitted smoothness that leaves a mesh whole is halved, at most so often.
constexpr int kMostHalvings = 5;

}  // namespace

Eigen::MatrixXd feature_values(const Mesh& mesh, SurfaceFeature feature, const Progress& progress) {
  const auto visibility = [&](VisibilityKind kind) {
    const Eigen::VectorXd values = continuous_visibility(mesh, {.kind = kind}, progress).values;
    return smooth_bilaterally(face_adjacency(mesh), face_means(mesh, values), default_window(mesh.faces.rows()));
  };
  switch (feature) {
    case SurfaceFeature::shape_diameter:
      return shape_diameter(mesh, {}, progress).values;
    case SurfaceFeature::visibility:
      return visibility(VisibilityKind::cvf);
    case SurfaceFeature::visibility_average:
      return visibility(VisibilityKind::avg);
    case SurfaceFeature::visibility_strong:
      return visibility(VisibilityKind::strong);
    case SurfaceFeature::visibility_weak:
      return visibility(VisibilityKind::weak);
  }
  throw InputError("feature", "it is none that is known", "give one of SurfaceFeature");
}

Segmentation segment_values(const Mesh& mesh, const Eigen::MatrixXd& values, const SegmentationSettings& settings) {
  ClusteringSettings clustering;
  clustering.clusters = settings.clusters == 0 ? fitted_clusters : settings.clusters;
  clustering.smoothness = settings.smoothness < 0 ? fitted_smoothness : settings.smoothness;
  clustering.by_length = clustering.by_area = true;
  clustering.seed = settings.seed;
  FaceClustering found = cluster_faces(mesh, values, clustering);
  for (int i = 0; i < kMostHalvings && settings.smoothness < 0 && found.segments == 1; ++i) {
    clustering.smoothness /= 2;
    found = cluster_faces(mesh, values, clustering);
  }
  return {.labels = std::move(found.labels),
          .parts = found.segments,
          .values = values,
          .clusters = clustering.clusters,
          .smoothness = clustering.smoothness,
          .seconds = {}};
}

Segmentation segment(const Mesh& mesh, const SegmentationSettings& settings, const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  progress("feature", 0);
  auto start = Clock::now();
  const Eigen::MatrixXd values = feature_values(mesh, settings.feature, progress);
  const double feature = seconds_since(start);
  progress("cluster", 0);
  start = Clock::now();
  Segmentation result = segment_values(mesh, values, settings);
  result.seconds = {{"feature", feature}, {"cluster", seconds_since(start)}};
  return result;
}

}  // namespace partwise
