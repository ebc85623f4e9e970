// How a surface reflects light from one direction into another: the bidirectional reflectance distribution function,
// and the angles of the half-vector by which isotropic ones are measured and modelled (Rusinkiewicz 1998, "A new change
// of variables for efficient BRDF representation").
//
// Directions are unit vectors in the frame of the surface, whose normal is +z. Values are linear RGB in 1/sr, without
// the cosine. Errors: none; a direction at or below the horizon gives zero.
#pragma once

#include <Eigen/Core>

namespace partwise {

class Brdf {
 public:
  virtual ~Brdf() = default;
  virtual Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const = 0;

 protected:
  Brdf() = default;
  Brdf(const Brdf&) = default;
  Brdf& operator=(const Brdf&) = default;
};

// Angles in radians, with h the half-vector, the direction of to_light + to_viewer.
struct HalfAngles {
  double theta_h = 0;  // between the normal and h, in [0, pi/2] above the horizon
  double theta_d = 0;  // between h and either direction, in [0, pi/2]
  double phi_d = 0;    // of the light about h, in (-pi, pi]; 0 lies in the plane of normal and h, away from the normal
};

// Any lengths will do. Well conditioned everywhere, as no arc cosine of a number near 1 is taken. Where the angle has
// no meaning (phi_d of theta_d = 0, both of h = n) it is what the axes of the frame make of it. Light and viewer
// changed for each other change phi_d by pi alone.
HalfAngles half_angles(const Eigen::Vector3d& to_light, const Eigen::Vector3d& to_viewer);

struct DirectionPair {
  Eigen::Vector3d to_light, to_viewer;
};

// The directions of these angles, with h in the half-plane y = 0, x >= 0. The reverse of half_angles for directions
// whose h lies there, and for others up to a turn about the normal.
DirectionPair directions_of(const HalfAngles& angles);

}  // namespace partwise
