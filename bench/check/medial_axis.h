// The inner medial axis of a solid from a dense sample of its surface: the inner poles of the sample's Voronoi diagram
// (Amenta, Choi, Kolluri 2001, *The power crust*), which converge to the axis as the sample grows denser.
//
// The inner pole of a sample is the farthest vertex of its Voronoi cell on the inner side of the face that it lies on.
// Kept are poles whose four nearest samples lie at least `least_angle` apart somewhere, seen from the pole: the others
// belong to bumps and to the triangulation. The ball must be empty of the surface itself, not only of samples, but for
// 2 % of its radius.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/check/shape.h"
#include "bench/check/solid.h"

namespace partwise::bench {

struct MedialAxisSettings {
  int samples = 200000;
  double least_angle = 60;  // degrees
  std::uint64_t seed = 1;
};

std::vector<Point> medial_axis(const Shape& shape, const Solid& solid, const MedialAxisSettings& settings);

// From each of `from` to the nearest of `to`, ascending. Neither may be empty.
std::vector<double> distances_to_nearest(const std::vector<Point>& from, const std::vector<Point>& to);

}  // namespace partwise::bench
