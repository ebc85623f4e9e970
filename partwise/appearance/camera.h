// Where a picture is taken from, and the camera that sees all of something.
//
// Right-handed, y up; the camera looks along its -z. Lengths in model units, angles in degrees.
#pragma once

#include <Eigen/Core>

#include <span>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct Camera {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // rows: right, up, and back (towards the viewer)
  Point position = Point::Zero();
  // Half of the picture's height: in model units when orthographic, else at distance 1 from the position.
  double half_height = 1;
  bool orthographic = false;
};

struct CameraView {
  double azimuth = 35;        // of the viewer about y, from +z towards +x
  double elevation = 20;      // of the viewer above the horizon, -90 to 90
  double field_of_view = 24;  // of the picture's height; 0: orthographic
  double fill = 0.86;         // share of the picture's width or height that what is seen takes, in (0, 1]
};

struct RoundPoints {  // spheres, or points of radius 0
  const Vertices* points = nullptr;
  double radius = 0;
};

// The nearest camera in the given direction that sees all spheres, which touch the frame on opposite sides.
// Errors: CheckFailed for no points and for a view out of range.
Camera frame_points(std::span<const RoundPoints> bodies, const CameraView& view, double width_over_height);

}  // namespace partwise
