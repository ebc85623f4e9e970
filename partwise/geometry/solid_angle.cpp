#include "partwise/geometry/solid_angle.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace partwise {

double solid_angle(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double solid_angle_winding(const Mesh& surface, const Point& p) {
  double sum = 0;
  for (const auto& face : surface.faces.rowwise())
    sum += solid_angle(
        {surface.vertices.row(face[0]) - p, surface.vertices.row(face[1]) - p, surface.vertices.row(face[2]) - p});
  return sum / (4 * std::numbers::pi);
}

}  // namespace partwise
