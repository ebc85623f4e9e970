// Directions of tangents, drawn evenly over the sphere.
#pragma once

#include "partwise/base/draw.h"
#include "partwise/motion/configuration_space.h"

namespace partwise {

Tangent drawn_direction(int degrees_of_freedom, Draw& draw);

}  // namespace partwise
