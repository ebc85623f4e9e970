// Where a robot can be: the plane, space, and both with rotation, SE(2) and SE(3), as coordinates, and as points of a
// Euclidean space in which distances mean how far the robot's body moves.
//
//   plane  x, y                          itself
//   space  x, y, z                       itself
//   se2    x, y, angle                   x, y, s cos, s sin
//   se3    x, y, z, quaternion w x y z   x, y, z, s / sqrt(2) times the nine entries of the rotation matrix
//
// The second column is the embedding that classifiers see. It is the scaled chart of the group without its seams: two
// quaternions of one rotation are one point, angles do not jump. s, the rotation scale, is the length that a radian is
// worth; the body's radius makes a distance a bound of how far any of its points moves, and for small rotations an
// embedded distance of s a radian.
//
// Tangents have a coordinate a degree of freedom: translation, then the rotation vector (about the origin of the body,
// in the world's frame) times s. Angles are in [-pi, pi), quaternions of unit length with w >= 0. Errors: InputError
// for bounds that are empty or not finite, CheckFailed for coordinates of another space.
#pragma once

#include <Eigen/Geometry>

#include "partwise/base/draw.h"

namespace partwise {

enum class SpaceKind { plane, space, se2, se3 };

inline bool is_planar(SpaceKind kind) { return kind == SpaceKind::plane || kind == SpaceKind::se2; }
inline int position_axes(SpaceKind kind) { return is_planar(kind) ? 2 : 3; }
inline int coordinate_count(SpaceKind kind) {
  return position_axes(kind) + (kind == SpaceKind::se2 ? 1 : kind == SpaceKind::se3 ? 4 : 0);
}

// Room for the largest embedding, so that none of this allocates.
using MotionVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
using Configuration = MotionVector;
using Tangent = MotionVector;

double wrapped_angle(double angle);  // in [-pi, pi)
// w x y z of the rotation, of unit length with w >= 0.
Eigen::Vector4d quaternion_coordinates(Eigen::Quaterniond rotation);

class ConfigurationSpace {
 public:
  // `bounds` are those of the position; the plane takes x and y of them. `rotation_scale` is positive where there is
  // rotation.
  ConfigurationSpace(SpaceKind kind, const Eigen::AlignedBox3d& bounds, double rotation_scale = 0);

  SpaceKind kind() const { return kind_; }
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  double rotation_scale() const { return scale_; }
  bool rotates() const { return kind_ == SpaceKind::se2 || kind_ == SpaceKind::se3; }
  int coordinates() const { return coordinate_count(kind_); }
  int degrees_of_freedom() const;
  int embedding() const;

  MotionVector embedded(const Configuration& q) const;
  // The gradient along tangents of a function of the embedding with gradient g there.
  Tangent pulled_back(const Configuration& q, const MotionVector& g) const;
  Configuration moved(const Configuration& q, const Tangent& by) const;
  // The tangent that moves a to b along the geodesic.
  Tangent difference(const Configuration& a, const Configuration& b) const;
  Configuration between(const Configuration& a, const Configuration& b, double share) const;
  // |translation| + s |rotation vector|: no point of a body within s of its origin moves farther from a to b.
  double displacement(const Configuration& a, const Configuration& b) const;

  bool within_bounds(const Configuration& q) const;
  // Evenly within the bounds, rotations evenly over the group.
  Configuration drawn(Draw& draw) const;
  Eigen::Isometry3d pose(const Configuration& q) const;

 private:
  int positions() const { return position_axes(kind_); }

  SpaceKind kind_;
  Eigen::AlignedBox3d bounds_;
  double scale_;
};

}  // namespace partwise
