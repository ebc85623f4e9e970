// SVG's path data (SVG 1.1, section 8.3) as cubic Bezier curves, and curves as chords.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/geometry/orientation.h"

namespace partwise {

struct Curve {
  std::array<Point2, 4> control;
  bool straight = false;  // control[0] to control[3]
};

// One closed curve a subpath: open ones are closed by a line, as filling does. Arcs are split into pieces of at most
// an eighth of a turn, which cubics follow to 4e-6 of the radius. Errors: InputError (place, what is wrong and where).
std::vector<std::vector<Curve>> parse_svg_path(const std::string& place, std::string_view data);

// translate, scale, rotate, skewX, skewY and matrix, in any number.
Eigen::Affine2d parse_svg_transform(const std::string& place, std::string_view text);

// Numbers separated by blanks and commas, as in `points`.
std::vector<double> parse_svg_numbers(const std::string& place, std::string_view text);

// Appends the corners of chords that leave the curve by at most the tolerance, without the last.
void flatten(const Curve& curve, double tolerance, std::vector<Point2>& corners);

}  // namespace partwise
