// Shape diameter function: how thick the solid is below each face (Shapira, Shamir, Cohen-Or 2008; section 2.2.4
// compares with it).
//
// From the middle of a face, rays run into the solid through a cone about the inward normal. The value is the mean
// length of the rays, without those that meet a face from its front and those farther from the median than 1.5 times
// the median absolute deviation. Rays are laid by a spiral (Vogel 1979) that is denser towards the axis, with equal
// weights, as in CGAL 5.5, whose raw values these are.
//
// Any triangle mesh, faces counter-clockwise from outside. A face has no value when it has no area or when no ray meets
// a face from behind (open meshes); it is then filled in from its neighbours (face_values.h).
// Errors: InputError for a mesh without a face of positive area, or settings out of range.
#pragma once

#include <Eigen/Core>

#include <numbers>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct ShapeDiameterSettings {
  int rays = 25;                                   // a face, at least 1
  double cone_angle = 2.0 / 3 * std::numbers::pi;  // radians, from side to side, above 0 and below pi
  int smoothing = -1;                              // window of the bilateral filter; 0: none; -1: default_window
};

struct ShapeDiameter {
  Eigen::VectorXd values;    // one a face, model units
  Eigen::Index missing = 0;  // how many were filled in
};

ShapeDiameter shape_diameter(const Mesh& mesh, const ShapeDiameterSettings& settings = {},
                             const Progress& progress = {});

}  // namespace partwise
