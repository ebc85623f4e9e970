// How far two segmentations of a mesh differ: the four measures of the Princeton benchmark (Chen, Golovinskiy,
// Funkhouser 2009, *A benchmark for 3D mesh segmentation*, section 4), as its published program computes them. All are
// 0 for equal segmentations, whatever the labels are called; labels are any integers, one a face, and faces of one
// label are one segment, connected or not.
//
// Where the benchmark's text leaves a choice or its program differs from it, the program is followed, so that figures
// can stand beside those of the literature:
// * Rand error: every face counts the same, large or small.
// * Hamming: areas. The text's directional distance of the segmentation to the reference is the missing rate.
// * Consistency: the refinement error of a face is a ratio of areas, its mean counts faces (the plotted variant).
// * Cut discrepancy: one mean over the vertices of both cuts (the text adds the means of the two directions).
//
// Units: none; rates are in [0, 1], the cut discrepancy is a distance over the model's mean radius. Time O(m) for m
// faces, save for shortest paths, O(m log m); no table of all pairs of segments is made.
//
// Errors: InputError when the labels are not as many as the faces, and for a mesh without area.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/topology.h"

namespace partwise {

struct SegmentationMeasures {
  // Share of the pairs of faces that one segmentation puts together and the other apart: 1 - Rand index. Symmetric.
  double rand_error = 0;

  // Mean distance along the surface from a vertex on a cut of one segmentation to the nearest on a cut of the other,
  // over the area-weighted mean distance of the faces' centroids to the surface's centroid. Symmetric.
  //
  // On a cut is a vertex of an edge whose faces differ in label. Distances are shortest paths over the edges of the
  // mesh, so longer than geodesics (up to 1.4 times in a grid of squares cut in two); where no path leads to a cut, on
  // a piece of the mesh of its own, the straight distance counts. 0 when neither has a cut; NaN, undefined, when just
  // one has none.
  double cut_discrepancy = 0;

  // Share of the area outside the best match: each segment of one side is matched with the segment of the other that
  // covers most of it, and what that does not cover is in error. `hamming_missing` goes over the segments of the
  // reference (high when its borders were missed), `hamming_false` over those of the segmentation (high when it
  // has borders of its own), `hamming` is their mean, and symmetric.
  double hamming = 0, hamming_missing = 0, hamming_false = 0;

  // The refinement error of a face is the share of its segment that lies outside its segment in the other
  // segmentation (Martin et al. 2001). Global: the mean in the better of the two directions; local: the mean of each
  // face's better direction. Both are 0 where one segmentation refines the other; local <= global. Symmetric.
  double consistency_global = 0, consistency_local = 0;
};

// One-off; for several references keep a SegmentationComparison.
SegmentationMeasures compare_segmentations(const Mesh& mesh, std::span<const int> segmentation,
                                           std::span<const int> reference);

// The mean of each measure, of the cut discrepancy over those where it is defined. Nothing to average: InputError.
SegmentationMeasures mean_measures(std::span<const SegmentationMeasures> measures);

// Throws the InputError for labels that are not as many as the faces. `place` is what the message calls them.
void require_label_per_face(const Mesh& mesh, std::span<const int> labels, const std::string& place);

// A segmentation that is compared with several references: what depends on the mesh and on it alone is computed once.
class SegmentationComparison {
 public:
  SegmentationComparison(const Mesh& mesh, std::span<const int> segmentation);

  SegmentationMeasures against(std::span<const int> reference) const;

 private:
  struct Step {
    int to;
    double length;
  };

  void add_steps();
  std::vector<int> cut_vertices(std::span<const int> labels) const;
  std::vector<double> path_lengths(const std::vector<int>& sources) const;
  double total_distance(const std::vector<int>& vertices, const std::vector<double>& lengths,
                        const std::vector<int>& cut) const;
  double cut_discrepancy(std::span<const int> reference) const;

  Vertices vertices_;
  std::vector<double> areas_;  // of the faces
  double mean_radius_ = 0;     // of the surface about its centroid
  std::vector<HalfEdge> half_edges_;
  std::vector<int> first_;  // from vertex v go steps_[first_[v]] .. steps_[first_[v + 1] - 1]
  std::vector<Step> steps_;
  std::vector<int> segmentation_;
  std::vector<int> cut_;          // vertices on its cuts, ascending
  std::vector<double> from_cut_;  // path length to each vertex; infinite where there is none
};

}  // namespace partwise
