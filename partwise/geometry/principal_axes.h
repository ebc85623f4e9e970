// Moments of a surface, and its principal axes: a frame that turns with the shape, so that work done in it does not
// depend on how the shape was placed.
//
// Eigenvectors of the second moments of area about the surface's centroid, integrated exactly over the faces; the
// largest first. Each points where the third moment is positive, and the last is turned so that the frame is
// right-handed. Moments that agree to rounding leave the axes (or their signs) to it: a sphere has no better. Axes that
// are those of the coordinates to within 1e-12 are made so exactly, which keeps coplanar faces of upright boxes so.
// Time O(m).
#pragma once

#include <Eigen/Core>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct SurfaceMoments {
  double area = 0;
  Point centroid = Point::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // about the centroid, over the area
};

// Integrated exactly over the faces; only the area, 0, for a mesh without one.
SurfaceMoments surface_moments(const Mesh& mesh);

// A rotation whose rows are the axes: `vertices * axes.transpose()` are the vertices in that frame. The identity for a
// mesh without area.
Eigen::Matrix3d principal_axes(const Mesh& mesh);

}  // namespace partwise
