#include "partwise/motion/directions.h"

#include <cmath>
#include <numbers>

namespace partwise {
namespace {

double normal(Draw& draw) {  // Box and Muller 1958
  const double radius = std::sqrt(-2 * std::log(1 - draw.unit()));
  return radius * std::cos(2 * std::numbers::pi * draw.unit());
}

}  // namespace

Tangent drawn_direction(int degrees_of_freedom, Draw& draw) {
  Tangent direction(degrees_of_freedom);
  for (double& each : direction) each = normal(draw);
  direction.normalize();
  return direction;
}

}  // namespace partwise
