// Depth brought into the view of the colour camera that stands beside, and lenses' distortion taken out of both.
//
// Each measured point goes to the nearest pixel of the colour camera; of several the one that is nearest to the camera
// stays, and pixels that none goes to are missing. Lenses are Brown's (1966): three radial and two tangential
// coefficients, of image coordinates x to the right and y down in units of the focal length. Colour is interpolated
// linearly; black where the camera saw nothing. Linear time. Errors: CheckFailed for pictures of different sizes; those
// of rgbd_frame.h.
#pragma once

#include <Eigen/Core>

#include <array>

#include "partwise/normals/truth/pinhole_camera.h"
#include "partwise/normals/truth/rgbd_frame.h"

namespace partwise {

struct LensDistortion {
  std::array<double, 3> radial{};
  std::array<double, 2> tangential{};
};

// Where the lens shows a point, and which point it shows there. Columns are x, rows y.
Eigen::Vector2d distorted(const LensDistortion& lens, const Eigen::Vector2d& point);
Eigen::Vector2d undistorted(const LensDistortion& lens, const Eigen::Vector2d& image);

struct DepthRig {
  PinholeCamera depth_camera, colour_camera;
  LensDistortion depth_lens{}, colour_lens{};
  // Of camera spaces (+x right, +y up, +z towards the camera), metres: rotation * point + offset is where the colour
  // camera has a point of the depth camera.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

// That of NYU Depth v2, by the calibration in its toolbox (Silberman, Hoiem, Kohli, Fergus 2012).
DepthRig nyu_rig();

RgbdFrame registered_frame(const RgbdFrame& frame, const DepthRig& rig);

// Registered already in the other data sets.
RgbdFrame read_registered_frame(const RgbdFiles& files);

}  // namespace partwise
