// Continuous visibility, a feature of surfaces that knows their parts (Liu 2017, section 2.2).
//
// A vertex q is continuously visible from p when a path over the surface leads from p to q all of which p sees through
// the solid. The feature's value at p is the area of what p sees so: the sum over the faces of their area times the
// share of their corners that are seen; model units squared. Of a convex solid every vertex has the whole area. What
// "sees" means at grazing contact is said in geometry/inner_visibility.h, and how the region is found in
// parts/surface/visible_region.h. Kinds:
//   cvf     as above.
//   avg     the mean of the vertex's value and of the value at the face that the ray against its normal meets first
//           (the mean of that face's corners); its own where the ray meets nothing. Section 2.2.4.3.
//   strong  the area of what is continuously visible both ways.
//   weak    the area of the vertices q for which the shortest path from p has at most `weak_threshold` R of its length
//           hidden from p, and the one from q as little from q, and that p sees. Paths run along the edges of the mesh;
//           an edge counts as hidden by half for each hidden end.
//
// Vertices at the same place are one vertex. Vertices without a face have the value 0. Components see only themselves
// but block each other. Open meshes: there is no solid where the surface is missing, so lines through a hole see.
// Inside is where faces are clockwise; a mesh turned inside out sees the air instead.
//
// The same result for any number of threads. Memory O(n), but for strong and weak, which keep all regions as runs:
// about a byte a vertex and contour edge. Errors: InputError for a mesh without a face of positive area, or a threshold
// that is not a positive number.
#pragma once

#include <Eigen/Core>

#include <cstdint>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/parts/surface/visibility_matrix.h"

namespace partwise {

enum class VisibilityKind { cvf, avg, strong, weak };
enum class VisibilityMethod { filter, bfs, bfs_plain, filter_printed };  // see visible_region.h

struct VisibilitySettings {
  VisibilityKind kind = VisibilityKind::cvf;
  VisibilityMethod method = VisibilityMethod::filter;  // of all kinds but weak, which searches in its own way
  double weak_threshold = 0.1;                         // share of the bounding-sphere radius
};

struct VisibilityFeature {
  Eigen::VectorXd values;   // of each vertex, model units squared
  std::uint64_t tests = 0;  // of pairs of vertices by a ray
};

VisibilityFeature continuous_visibility(const Mesh& mesh, const VisibilitySettings& settings = {},
                                        const Progress& progress = {});

// The vector form: which vertices each vertex sees continuously. Rows and columns are numbered as `of_vertex` says,
// which numbers vertices so that rows are short; -1 for vertices without a face.
struct VisibilityVectors {
  VisibilityMatrix sees{0};
  std::vector<int> of_vertex;
  std::uint64_t tests = 0;
};
VisibilityVectors visibility_vectors(const Mesh& mesh, VisibilityMethod method = VisibilityMethod::filter,
                                     const Progress& progress = {});

// Values of vertices averaged over the corners of each face, and of faces over those at each vertex by their areas (0
// where there is none with an area).
Eigen::VectorXd face_means(const Mesh& mesh, const Eigen::VectorXd& vertex_values);
Eigen::VectorXd vertex_means(const Mesh& mesh, const Eigen::VectorXd& face_values);

}  // namespace partwise
