#include "partwise/parts/surface/segmentation.h"

#include <chrono>
#include <map>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/face_clustering.h"
#include "partwise/parts/surface/face_values.h"
#include "partwise/parts/surface/fitted_borders.h"
#include "partwise/parts/surface/piece_merging.h"
#include "partwise/parts/surface/shape_diameter.h"

namespace partwise {
namespace {

// A fitted smoothness that leaves a mesh whole is halved, at most so often.
constexpr int kMostHalvings = 5;

// Of the pieces that learnt borders are among.
constexpr double kPieceSmoothness = 4, kLeastPiece = 0.0005;

ClusteringSettings clustering_settings(int clusters, double smoothness, std::uint64_t seed) {
  ClusteringSettings clustering;
  clustering.clusters = clusters;
  clustering.smoothness = smoothness;
  clustering.by_length = clustering.by_area = true;
  clustering.seed = seed;
  return clustering;
}

Borders borders_of(const SegmentationSettings& settings) {
  const bool average = settings.feature == SurfaceFeature::visibility_average;
  const bool told = settings.clusters != 0 || settings.smoothness >= 0;
  if (settings.borders == Borders::learnt && (!average || told)) {
    throw InputError("borders", "learnt ones go with averaged visibility, and without clusters or smoothness",
                     "leave one of them out");
  }
  if (settings.borders != Borders::automatic) return settings.borders;
  return average && !told ? Borders::learnt : Borders::plain;
}

// values: visibility and thickness.
Segmentation merged_pieces(const Mesh& mesh, const Eigen::MatrixXd& values, std::uint64_t seed) {
  const Components pieces = segmentation_pieces(mesh, values.col(0), values.col(1), seed);
  const std::vector<int> part = merge_pieces(PieceGraph(mesh, values.col(0), values.col(1), pieces), fitted_borders());
  std::vector<int> labels;
  for (const int piece : pieces.label) labels.push_back(part[piece]);
  Components parts = label_pieces(face_adjacency(mesh), labels);
  return {.labels = std::move(parts.label),
          .parts = parts.count,
          .borders = Borders::learnt,
          .values = values,
          .clusters = fitted_clusters,
          .smoothness = kPieceSmoothness,
          .seconds = {}};
}

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
  ClusteringSettings clustering =
      clustering_settings(settings.clusters == 0 ? fitted_clusters : settings.clusters,
                          settings.smoothness < 0 ? fitted_smoothness : settings.smoothness, settings.seed);
  FaceClustering found = cluster_faces(mesh, values, clustering);
  for (int i = 0; i < kMostHalvings && settings.smoothness < 0 && found.segments == 1; ++i) {
    clustering.smoothness /= 2;
    found = cluster_faces(mesh, values, clustering);
  }
  return {.labels = std::move(found.labels),
          .parts = found.segments,
          .borders = Borders::plain,
          .values = values,
          .clusters = clustering.clusters,
          .smoothness = clustering.smoothness,
          .seconds = {}};
}

Components segmentation_pieces(const Mesh& mesh, const Eigen::VectorXd& visibility, const Eigen::VectorXd& thickness,
                               std::uint64_t seed) {
  ClusteringSettings clustering = clustering_settings(fitted_clusters, kPieceSmoothness, seed);
  clustering.least_area = kLeastPiece;
  const FaceClustering seen = cluster_faces(mesh, visibility, clustering),
                       thick = cluster_faces(mesh, thickness, clustering);
  std::map<std::pair<int, int>, int> numbers;  // a piece is in one segment of each
  std::vector<int> both;
  for (std::size_t f = 0; f < seen.labels.size(); ++f)
    both.push_back(numbers.try_emplace({seen.labels[f], thick.labels[f]}, static_cast<int>(f)).first->second);
  return join_small_pieces(mesh, label_pieces(face_adjacency(mesh), both), kLeastPiece);
}

Segmentation segment(const Mesh& mesh, const SegmentationSettings& settings, const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const Borders borders = borders_of(settings);
  progress("feature", 0);
  auto start = Clock::now();
  Eigen::MatrixXd values = feature_values(mesh, settings.feature, progress);
  if (borders == Borders::learnt) {
    values.conservativeResize(Eigen::NoChange, 2);
    values.col(1) = feature_values(mesh, SurfaceFeature::shape_diameter, progress);
  }
  const double feature = seconds_since(start);
  progress("cluster", 0);
  start = Clock::now();
  Segmentation result =
      borders == Borders::learnt ? merged_pieces(mesh, values, settings.seed) : segment_values(mesh, values, settings);
  result.seconds = {{"feature", feature}, {"cluster", seconds_since(start)}};
  return result;
}

}  // namespace partwise
