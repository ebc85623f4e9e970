// A ball in a material: the picture by which people know materials.
//
// The ball is seen along -z from afar and touches the frame; it needs no rays, as its normals are known. Light is taken
// at the full resolution of its map, by patches (light_tree.h), so that mirrors show it sharply. Errors: CheckFailed
// for sizes below 1.
#pragma once

#include "partwise/appearance/material/brdf.h"
#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/imaging/image.h"

namespace partwise {

// What a camera at distance 2 sees of a ball of radius 1, size x size pixels, all of it part 0.
GBuffer ball_view(int size, int samples);

// Linear RGB and alpha, the share of the pixel that the ball covers.
Image material_ball(const Brdf& material, const LightTree& light, int size);

// What to multiply images under this light with, as a photographer would who holds a grey card into it: the median over
// a matt ball of albedo 0.18 becomes 0.18. So black stays black and white white, where exposure_by_median makes all
// materials as bright. No light: 1.
float grey_card_exposure(const EnvironmentLight& light);

// The light multiplied by it.
EnvironmentLight exposed_for_grey_card(const EnvironmentLight& light);

}  // namespace partwise
