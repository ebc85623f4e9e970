// Points spread evenly over the boundaries of convex hulls: along outlines in the plane, over surfaces in space.
#pragma once

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/motion/configuration_space.h"

namespace partwise {

double boundary_size(const Ring& hull);  // length
double boundary_size(const Mesh& hull);  // area

struct BoundaryPoint {
  int hull = 0;
  MotionVector at;
};

// `count` points, one for each equal share of the hulls' boundaries laid end to end, at `phase` in [0, 1) of the share;
// across triangles they run through a golden-ratio sequence.
std::vector<BoundaryPoint> even_points(std::span<const Ring> hulls, int count, double phase = 0.5);
std::vector<BoundaryPoint> even_points(std::span<const Mesh> hulls, int count, double phase = 0.5);

}  // namespace partwise
