// Segments of a mesh from scalars on its faces: soft clustering by a Gaussian mixture, then a cut through the graph of
// faces (section 2.2.4.2, the clustering that CGAL documents for the shape diameter function).
//
// Every column of values is scaled to [0, 1], a mixture of k Gaussians is fitted, and each face takes one of the k
// clusters so that
//
//   sum over faces of size x -log p(cluster | face)  +  smoothness x sum over edges between clusters of weight
//
// is low (alpha expansion). weight = length x -log(t angle / pi), with angle that by which the surface bends at the
// edge (0 where it is flat) and t = 1 where it bends inwards, convex_factor where it bends outwards: creases, and
// concave ones most of all, are cheap to cut. length and size are 1, or if `by_length` and `by_area` say so, size is
// the face's area in units of the mean area, and length the edge's in units of 200 sqrt(whole area) / faces, which is
// about the mean length on a mesh of 20000 faces. With both, energy a face is an integral over the surface and one
// along the borders, so that a mesh that is finer, in places or as a whole, gives the same segments. Segments are the
// connected pieces of clusters (across edges), so that there may be many more of them than k.
//
// Any triangle mesh: edges with one face bind nothing, edges with more than two bind the chain of topology.h, faces
// without area are flat continuations of their neighbours. Deterministic for a seed.
// Errors: InputError for values that are not finite or do not fit the mesh, or settings out of range.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/surface/alpha_expansion.h"

namespace partwise {

struct ClusteringSettings {
  int clusters = 5;             // k, at least 1
  double smoothness = 26;       // at least 0; CGAL's lambda is a hundredth of it
  double bend = 0;              // of the scale of the values (face_values.h): 0 linear, CGAL 5
  double convex_factor = 0.08;  // above 0, at most 1
  bool by_length = false;       // weigh edges by their length
  bool by_area = false;         // weigh faces by their area, in the mixture and in the cut
  double least_area = 0;        // segments with less than this share of the surface join their neighbours
  std::uint64_t seed = 0;
};

struct FaceClustering {
  std::vector<int> labels;  // segment of each face, numbered by their first face
  int segments = 0;
  std::vector<int> clusters;  // cluster of each face before small segments were joined, ascending by first value
};

// values: m x d, one row a face.
FaceClustering cluster_faces(const Mesh& mesh, const Eigen::MatrixXd& values, const ClusteringSettings& settings = {});

// Its steps.

// m x k: size x -log p(cluster | face), at most -log(5e-6) each.
Eigen::MatrixXd cluster_costs(const Mesh& mesh, const Eigen::MatrixXd& values, const ClusteringSettings& settings);

// Two faces that follow each other at an edge: its length in model units, and how little it looks like a border,
// -log(t angle / pi).
struct FaceBorder {
  int a = 0, b = 0;
  double length = 0, flatness = 0;
};
std::vector<FaceBorder> face_borders(const Mesh& mesh, double convex_factor);

// The same as links with the weights above, without smoothness.
std::vector<LabelLink> face_links(const Mesh& mesh, const ClusteringSettings& settings);

// Connected pieces of equal labels, numbered by their first face.
Components label_pieces(const FaceAdjacency& adjacency, std::span<const int> labels);

// Pieces whose faces have less than least_area of the whole area join, smallest first, the neighbour with which they
// share the longest border. A component of the mesh that is a single piece stays.
Components join_small_pieces(const Mesh& mesh, Components pieces, double least_area);

}  // namespace partwise
