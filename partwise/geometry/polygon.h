// Polygons with holes in the plane.
//
// A ring is a closed curve given by its corners, the first not repeated. In a polygon the outer ring runs
// counter-clockwise (x right, y up; in pixel coordinates, y down, it therefore looks clockwise) and holes run
// clockwise. Valid means what the OpenGIS simple features standard means: rings are simple, holes lie inside, rings
// touch at points only, the interior is connected, and polygons of one shape do not overlap.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <span>
#include <string>
#include <vector>

namespace partwise {

using Ring = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

using Polygons = std::vector<Polygon>;

// Positive when the ring runs counter-clockwise.
double signed_area(const Ring& ring);
double area(const Polygon& polygon);
double area(std::span<const Polygon> polygons);

// Turns rings to the directions above. Repeated successive corners and rings of fewer than three corners go.
void normalise(Polygons& polygons);

// Of all corners; empty for no polygons.
Eigen::AlignedBox2d bounding_box(std::span<const Polygon> polygons);

struct Circle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0;
};

// The smallest circle around all corners (Welzl 1991).
Circle enclosing_circle(std::span<const Polygon> polygons);

// Polygons from rings of any direction, which may nest but must not cross. A point is filled where an odd number of
// rings encloses it (even_odd), or where their directions do not cancel (non_zero, as SVG has it by default).
enum class FillRule { even_odd, non_zero };
Polygons assemble_polygons(std::vector<Ring> rings, FillRule rule);

}  // namespace partwise
