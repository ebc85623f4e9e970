// The pinhole camera of a picture in pixels, as calibrations give it, and the rays of its pixels.
//
// A point (X, Y, -Z) of camera space (+x right, +y up, +z towards the camera, so Z > 0 is its depth) is seen at column
// centre_x + focal_x X / Z and row centre_y - focal_y Y / Z; columns and rows count from the middle of the first pixel,
// rows downwards. Lens distortion is not in it. Errors: CheckFailed for a camera that cannot be.
#pragma once

#include <Eigen/Core>

namespace partwise {

struct Camera;

struct PinholeCamera {
  double focal_x = 0, focal_y = 0;    // pixels
  double centre_x = 0, centre_y = 0;  // pixels

  // Times its depth it is the point that the pixel sees; its z is -1.
  Eigen::Vector3d ray(double column, double row) const {
    return {(column - centre_x) / focal_x, (centre_y - row) / focal_y, -1};
  }
};

// That of a picture rendered with a perspective camera.
PinholeCamera pinhole_camera(const Camera& camera, int width, int height);

}  // namespace partwise
