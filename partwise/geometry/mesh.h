// A triangle mesh as the field's tools have it: n x 3 positions and m x 3 vertex indices, counter-clockwise from
// outside.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace partwise {

using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Point = Eigen::RowVector3d;

struct Mesh {
  Vertices vertices;  // n x 3, model units
  Faces faces;        // m x 3, indices into vertices
};

struct Sphere {
  Point centre = Point::Zero();
  double radius = 0;
};

// The smallest sphere that encloses all vertices used by a face (Welzl 1991 on the few that matter: Gaertner 1999). A
// mesh without faces: radius 0.
Sphere bounding_sphere(const Mesh& mesh);

// Signed volume by the divergence theorem, positive when faces are counter-clockwise from outside. For closed meshes.
double signed_volume(const Mesh& mesh);

// Of each face, model units squared.
std::vector<double> face_areas(const Mesh& mesh);

}  // namespace partwise
