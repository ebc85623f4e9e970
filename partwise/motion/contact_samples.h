// Configurations at which a robot touches an obstacle, each with the obstacle's number: what the field learns from
// (Liu 2017, section 5.5.1). For a point they lie on the convex hulls of the obstacles' parts, evenly: along the hull's
// perimeter in the plane, by area over its surface in space.
//
// Errors: CheckFailed for another number of hulls and obstacle numbers.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/motion/configuration_space.h"

namespace partwise {

using MotionPoints = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct ContactSamples {
  MotionPoints points;         // embedded, a row each
  std::vector<int> obstacles;  // of each row
  int count = 0;               // of obstacles

  Eigen::Index size() const { return points.rows(); }
};

// Of points, each with its obstacle, of `count`.
ContactSamples assembled(const std::vector<MotionVector>& points, std::vector<int> obstacles, int count);

// hulls[i], convex, belongs to obstacles[i]; `each` samples an obstacle, shared out among its hulls by their size.
ContactSamples contact_samples(const std::vector<Ring>& hulls, const std::vector<int>& obstacles, int each);
ContactSamples contact_samples(const std::vector<Mesh>& hulls, const std::vector<int>& obstacles, int each);

// Fewer, where few are enough: no two of an obstacle are nearer to each other than `density` times the smaller of their
// distances from the nearest sample of another obstacle, and every dropped one has a kept one that near (after Amenta
// and Bern 1998, who sample a curve by its distance to the medial axis).
ContactSamples thinned(const ContactSamples& samples, double density);

}  // namespace partwise
