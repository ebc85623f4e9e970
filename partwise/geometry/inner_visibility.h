// Which vertices of a mesh see each other through the solid.
//
// Two vertices see each other when the segment between them lies in the closed solid: touching the surface along faces,
// edges or vertices does not block. To decide that by a plain occlusion test, each end is first moved inwards against
// its normal (angle-weighted mean of its faces') by 1e-4 R, or by a quarter of the wall's thickness there where the
// wall is thinner than four times that; R is the radius of the bounding sphere. A segment is then blocked if it meets
// any face. The mesh and the moved ends are rounded to single precision, as Embree has them, and its robust mode misses
// no face at shared edges and vertices; a segment that passes an edge at less than about 1e-6 R may be decided either
// way, but is decided the same way each time, and from both ends alike. Faces without area block nothing.
//
// All queries are const and may run in parallel. Errors: InputError for a mesh without a face of positive area.
#pragma once

#include <memory>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

class InnerVisibility {
 public:
  explicit InnerVisibility(const Mesh& mesh);
  ~InnerVisibility();
  InnerVisibility(InnerVisibility&&) noexcept;
  InnerVisibility& operator=(InnerVisibility&&) noexcept;

  bool sees(int p, int q) const;

  // The moved vertices, centred and scaled to R = 1 and rounded to single precision: the ends of the rays.
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>& inner_points() const;

  // The face that the ray from a vertex against its normal meets first, farther than 1e-4 R; -1 for none.
  int opposite_face(int vertex) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

// Angle-weighted vertex normals (Thuermer, Wuethrich 1998); zero for vertices without a face of positive area.
Vertices vertex_normals(const Mesh& mesh);

}  // namespace partwise
