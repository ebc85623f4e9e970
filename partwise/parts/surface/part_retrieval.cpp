#include "partwise/parts/surface/part_retrieval.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "partwise/base/error.h"
#include "partwise/parts/surface/maximum_matching.h"
#include "partwise/parts/surface/segmentation.h"
#include "partwise/parts/surface/surface_centricity.h"

namespace partwise {
namespace {

// Weights between all nodes of two hierarchies: a pair of nodes lies on the paths of many pairs of parts.
Eigen::MatrixXd node_weights(const PartHierarchy& a, const std::vector<int>& nodes, const PartHierarchy& b) {
  Eigen::MatrixXd weights(nodes.size(), b.nodes());
  for (Eigen::Index i = 0; i < weights.rows(); ++i) {
    for (int k = 0; k < b.nodes(); ++k) {
      weights(i, k) = histogram_similarity(a.histograms.row(nodes[i]), b.histograms.row(k));
    }
  }
  return weights;
}

double path_similarity(const Eigen::MatrixXd& weights, const std::vector<int>& path) {
  const Eigen::MatrixXd own = weights(Eigen::all, path);
  return 2 * maximum_weight_matching(own).weight / static_cast<double>(own.rows() + own.cols());
}

void require_part(const PartIndex& index, int part) {
  if (part >= 0 && part < index.hierarchy.parts) return;
  std::string known;
  for (int k = 0; k < index.hierarchy.parts; ++k) {
    known += fmt::format("{}{} ({:.1f} %)", k == 0 ? "" : ", ", k, 100 * index.hierarchy.histograms.row(k).sum());
  }
  throw InputError("part", fmt::format("there is no part {}", part),
                   fmt::format("give one of these, with its share of the area: {}", known));
}

}  // namespace

std::vector<int> PartIndex::face_counts() const {
  std::vector<int> counts(static_cast<std::size_t>(hierarchy.parts), 0);
  for (const int label : labels) ++counts[static_cast<std::size_t>(label)];
  return counts;
}

PartIndex index_parts(const Mesh& mesh, const Progress& progress) {
  Segmentation segments = segment(mesh, {}, progress);  // with learnt borders: its values are visibility and thickness
  PARTWISE_CHECK(segments.values.cols(), ==, 2);
  PartHierarchy hierarchy =
      part_hierarchy(mesh, segments.labels, {segments.values.col(0), segments.values.col(1), surface_centricity(mesh)});
  return {std::move(hierarchy), std::move(segments.labels)};
}

double histogram_similarity(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) {
  const double joint = a.cwiseMax(b).sum();
  return joint > 0 ? a.cwiseMin(b).sum() / joint : 1;
}

double part_similarity(const PartHierarchy& a, int part_a, const PartHierarchy& b, int part_b) {
  return path_similarity(node_weights(a, a.root_path(part_a), b), b.root_path(part_b));
}

std::vector<PartMatch> similar_parts(const PartIndex& query, int part, const std::vector<const PartIndex*>& indices,
                                     int count) {
  require_part(query, part);
  const std::vector<int> path = query.hierarchy.root_path(part);
  std::vector<PartMatch> matches;
  for (std::size_t mesh = 0; mesh < indices.size(); ++mesh) {
    const PartHierarchy& hierarchy = indices[mesh]->hierarchy;
    const Eigen::MatrixXd weights = node_weights(query.hierarchy, path, hierarchy);
    for (int k = 0; k < hierarchy.parts; ++k) {
      matches.push_back({static_cast<int>(mesh), k, path_similarity(weights, hierarchy.root_path(k))});
    }
  }
  std::ranges::sort(matches, {}, [](const PartMatch& m) { return std::tuple(-m.similarity, m.mesh, m.part); });
  if (matches.size() > static_cast<std::size_t>(std::max(count, 0))) matches.resize(static_cast<std::size_t>(count));
  return matches;
}

}  // namespace partwise
