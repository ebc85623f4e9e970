// Light that is drawn for training: photographed maps made over, and lamps that nobody photographed. Internal to this
// room.
//
//   photographed  one of the maps given, turned about y and mirrored half of the time; or half of the time the sum of
//                 two, the second up to eight times weaker; each brighter, darker and tinted by 2^-0.25 to 2^0.25
//   lamps         one time in four: up to four round lamps with soft edges, 4 to 25 degrees in radius, no lower than
//                 10 degrees under the horizon, of different brightness and tint, over a sky that changes from bottom
//                 to top and gives a tenth to seven tenths of the energy
#pragma once

#include <vector>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/base/draw.h"

namespace partwise {

// All maps have one size, that of the result.
EnvironmentLight drawn_light(Draw& draw, const std::vector<EnvironmentLight>& maps);

}  // namespace partwise
