// Dual-space decomposition (DuDe) of shapes in the plane, with any number of holes, into nearly convex parts (Liu 2017,
// section 2.3; Liu, Xi, Lien 2014).
//
// The shape is cut along diagonals between its own corners, so that the parts tile it exactly. A part is within the
// tolerance when none of its corners is farther than it from the part's convex hull, measured to the edge of the hull
// that bridges the corner's pocket, and no corner of a hole is farther than it from the segment between the hole's two
// corners farthest apart. Holes that are within the tolerance in the input are noise: they stay holes, but steer no
// cut.
//
// The same input and settings give the same parts.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

struct OutlineSettings {
  double tolerance = 0.05;  // share of the radius of the shape's smallest enclosing circle
  bool absolute = false;    // the tolerance is in the units of the shape
};

struct OutlineHole {
  int polygon = 0, index = 0;  // where it is in the input
  double concavity = 0;        // in the unit of the tolerance
  bool noise = false;
};

struct OutlineCut {
  Eigen::Vector2d a, b;
  int left = 0, right = 0;  // parts, seen from a to b
};

struct Outline {
  Polygons parts;
  std::vector<OutlineCut> cuts;
  std::vector<OutlineHole> holes;
  double tolerance = 0;  // as given
  double concavity = 0;  // the largest of any part, in the unit of the tolerance
  double radius = 0;     // of the smallest enclosing circle, units of the shape
  int unresolved = 0;    // features that no resolver was found for when they were met; their parts were cut otherwise
  std::vector<std::pair<std::string, double>> seconds;  // wall time by stage

  int holes_noise() const;
  int holes_kept() const { return static_cast<int>(holes.size()) - holes_noise(); }
};

// The polygons must be valid (polygon_validity.h). Errors: InputError for an empty shape, or a tolerance that is not
// above 0 or finite.
Outline decompose_outline(std::span<const Polygon> shape, const OutlineSettings& settings = {},
                          const Progress& progress = {});

}  // namespace partwise
