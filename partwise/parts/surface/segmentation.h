// Segments of a mesh, as people would cut it, from a feature of its surface (section 2.2.4.2).
//
// A feature is computed a face, smoothed on the graph of faces, and clustered (face_clustering.h). Then one of two:
//   plain   Two numbers decide: how many clusters, and how dear borders between them are; both have values that were
//           fitted to the Princeton benchmark, one pair for all meshes. Where the fitted smoothness leaves a mesh whole
//           it is halved until that is not so, at most five times: a surface with one value everywhere stays whole.
//   learnt  Clusters of visibility_average and of shape_diameter, with cheap borders, give many pieces; those are
//           merged across the borders that people would not draw (piece_merging.h).
// docs/segment.md says how both were fitted.
//
// Any triangle mesh with a face of positive area, faces counter-clockwise from outside. Deterministic for a seed, the
// same for any number of threads. Errors: InputError.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/geometry/topology.h"

namespace partwise {

enum class SurfaceFeature {
  shape_diameter,  // shape_diameter.h
  visibility,      // continuous_visibility.h, the kinds cvf, avg, strong and weak
  visibility_average,
  visibility_strong,
  visibility_weak,
};

// What is taken for every feature and mesh unless told otherwise.
inline constexpr int fitted_clusters = 8;
inline constexpr double fitted_smoothness = 24;

enum class Borders {
  automatic,  // learnt with visibility_average, unless a number of clusters or a smoothness is given; plain otherwise
  plain,
  learnt,  // with visibility_average only
};

struct SegmentationSettings {
  SurfaceFeature feature = SurfaceFeature::visibility_average;
  Borders borders = Borders::automatic;
  int clusters = 0;        // 0: fitted_clusters
  double smoothness = -1;  // ClusteringSettings::smoothness; below 0: fitted_smoothness
  std::uint64_t seed = 0;
};

struct Segmentation {
  std::vector<int> labels;  // a face, 0 .. parts - 1; each part is connected, numbered by its first face
  int parts = 0;
  Borders borders = Borders::plain;  // plain or learnt
  Eigen::MatrixXd values;            // of the feature, a row a face, as they were clustered; learnt: and thickness
  int clusters = 0;                  // the settings in use
  double smoothness = 0;
  std::vector<std::pair<std::string, double>> seconds;  // by stage, wall time
};

Segmentation segment(const Mesh& mesh, const SegmentationSettings& settings = {}, const Progress& progress = {});

// Its stages, for whoever tries several settings on one mesh: the values that are clustered, m x 1; the plain
// clustering of any such values, which may also have several columns; and the pieces that learnt borders are among.
Eigen::MatrixXd feature_values(const Mesh& mesh, SurfaceFeature feature, const Progress& progress = {});
Segmentation segment_values(const Mesh& mesh, const Eigen::MatrixXd& values, const SegmentationSettings& settings = {});
Components segmentation_pieces(const Mesh& mesh, const Eigen::VectorXd& visibility, const Eigen::VectorXd& thickness,
                               std::uint64_t seed = 0);

}  // namespace partwise
