// Another shape out of a view: an affine map of the object that leaves the direction of viewing as it is. Seen from far
// away it takes the surface that was seen to the surface that is seen, pixel by pixel and with nothing uncovered, so
// that the new view is as exact as the old; cameras that are near make it an approximation. Networks that have few
// shapes to learn from get many this way.
//
// The map: (x, y) becomes plane (x, y), z becomes depth z + lean . (x, y), in camera space, +x right, +y up, +z towards
// the camera. Normals are changed by the inverse of its transpose.
#pragma once

#include <ATen/core/Tensor.h>

#include <Eigen/Core>

namespace partwise {

struct ViewWarp {
  Eigen::Matrix2d plane = Eigen::Matrix2d::Identity();  // any that can be inverted, mirrors too
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  double depth = 1;  // above 0
  double share = 1;  // of the picture's side, that the object's longer side takes; above 0
};

// Normals 3 x S x S, floats, zero in the background; the result likewise, with the object in the middle. Between pixels
// normals are interpolated, and object is where the weights of object pixels come to more than a half. Without object:
// as it is. Errors: CheckFailed for other shapes and for a map that cannot be inverted.
at::Tensor warped_normals(const at::Tensor& normals, const ViewWarp& warp);

// The parts of the same view, S x S of bytes, 0 in the background; each pixel's that of the object's pixel that is
// nearest to where it comes from, of the four about it. Object is what it is for the normals.
at::Tensor warped_parts(const at::Tensor& parts, const ViewWarp& warp);

}  // namespace partwise
