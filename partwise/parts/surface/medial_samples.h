// Points of the medial axis of a solid, from what its vertices see continuously (Liu 2017, section 2.2.4.5; the
// reference points are those of Liu, Zhang, Shamir and Cohen-Or 2009).
//
// Each vertex p looks into the solid against its normal, along d. A ball that touches the surface at p, has its centre
// on that line and reaches another vertex q has the radius |pq|^2 / (2 d . (q - p)). The least over the vertices that p
// sees continuously gives the sample: its centre, as far from p as from q. Vertices q that the centre would see at less
// than `least_angle` from p do not count: so near the tangent plane, bumps and the triangulation decide, not the shape.
// Balls that then reach through the surface by more than `most_overlap` of their radius are left out.
//
// Long edges are halved first until none is longer than `spacing`, so that a box's samples do not all come from its
// corners; the work grows with the square of the number of vertices. Inside is where faces are
// clockwise. An open mesh gives the samples of what its sheets enclose. Errors: InputError for a mesh without a face of
// positive area or settings out of range.
#pragma once

#include <numbers>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct MedialSettings {
  double spacing = 0.1;                       // share of the bounding-sphere radius, at least 0.005
  double least_angle = std::numbers::pi / 3;  // radians in [0, pi]
  double most_overlap = 0.05;                 // in (0, 1]
};

struct MedialSamples {
  Vertices points;            // the centres, in order of the vertices that they belong to
  std::vector<double> radii;  // distance to the surface but for most_overlap, model units
};

MedialSamples medial_samples(const Mesh& mesh, const MedialSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
