// Parts like a given part, of other meshes: part-based retrieval (section 2.2.4.4).
//
// Two parts are compared with what they belong to. Between the nodes of the two paths from the parts up to the roots of
// their hierarchies (part_hierarchy.h) each pair has a weight in [0, 1], how alike its histograms are; the
// maximum-weight matching (maximum_matching.h) of the two paths is the score. Over the mean length of the paths it is a
// similarity in [0, 1], symmetric, and 1 for a part with itself.
//
// The weight of two nodes is the common area of their histograms over the joint area, sum of minima over sum of maxima:
// 1 when both show the same share of their meshes at all levels of visibility, thickness and centricity. Form, size and
// place on the mesh count at once.
//
// Meshes of any scale and position; segments are those of partwise::segment with its defaults and seed 0, so that parts
// have the numbers that `partwise segment --feature cvf-avg` gives them.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/parts/surface/part_hierarchy.h"

namespace partwise {

// All that is kept of a mesh.
struct PartIndex {
  PartHierarchy hierarchy;
  std::vector<int> labels;  // part of each face

  std::vector<int> face_counts() const;  // of each part
};

// Errors: InputError as of partwise::segment.
PartIndex index_parts(const Mesh& mesh, const Progress& progress = {});

// Weight of two nodes, given by their histograms; 1 for two without area.
double histogram_similarity(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b);

double part_similarity(const PartHierarchy& a, int part_a, const PartHierarchy& b, int part_b);

struct PartMatch {
  int mesh = 0;  // which of the indices
  int part = 0;
  double similarity = 0;
};

// The `count` parts most like `part` of `query`, best first; equal ones by mesh and part. Errors: InputError for a part
// that the query does not have; the message says which there are.
std::vector<PartMatch> similar_parts(const PartIndex& query, int part, const std::vector<const PartIndex*>& indices,
                                     int count);

}  // namespace partwise
