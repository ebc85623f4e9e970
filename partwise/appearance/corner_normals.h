// Normals for shading: of each corner of each face the mean, by area, of the normals of the faces at its vertex that
// lie within a crease angle of its own face. 0 degrees: every face is flat; 180: all edges are smooth.
#pragma once

#include <Eigen/Core>

#include "partwise/geometry/mesh.h"

namespace partwise {

using CornerNormals = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;  // row 3 f + k: corner k of face f

// Unit length; zero for a corner whose faces have no area.
CornerNormals corner_normals(const Mesh& mesh, double crease_degrees);

}  // namespace partwise
