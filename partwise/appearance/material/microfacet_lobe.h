// One lobe of microfacet_brdf.h at one pair of directions, which its fit needs as well.
#pragma once

#include "partwise/appearance/material/microfacet_brdf.h"

namespace partwise {

struct LobeAngles {
  double cos_i = 0, cos_o = 0, cos_h = 0, cos_d = 0;
};

// D G / (4 cos_i cos_o), or what stands for it.
double lobe_value(LobeShape shape, double roughness, const LobeAngles& at);

// (1 - cos theta_d)^5 where the shape has Schlick's reflectance.
double schlick_share(LobeShape shape, double cos_d);

}  // namespace partwise
