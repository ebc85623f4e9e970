// What networks have read off a picture, made to explain it better (dissertation, section 3.3.5): L-BFGS on
//
//   |I* - I|^2 + a |n* - n|^2 + b |L* - L|^2 + c |m* - m|^2                                    (3.6)
//
// over material, light and normals, one after the other, again and again. I and I* are display values, sums over the
// object's pixels and channels. The dissertation's other squares (a = 1, b = 10, c = 0) are of every pixel by itself,
// as if what networks get wrong were noise. Here changes of normals (unit vectors) and of the logarithm of light are
// sums of levels (error_levels.h), those of a material sums of what the shipped training materials differ by from
// their mean, so that it stays like a material; |.|^2 counts either in units of the variance that the networks' errors
// have, and weights are of one order. Where the picture is as white as it can be, more light is no error.
//
// Regions have a material each; light and normals are one for all. Shapes: pictures 1 x 4 x S x S, region masks
// 1 x 1 x S x S, materials (scaled) R x 108. Errors: CheckFailed for other shapes.
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/editing/editing_networks.h"

namespace partwise {

struct RefinementSettings {
  double normal_weight = 0.1, light_weight = 0.03, material_weight = 0.05;  // a, b, c
  bool normals_known = false;                                               // stay as they are
  int rounds = 4;
  int steps = 5;         // of L-BFGS, of each of the three a round
  int layer_light = 64;  // columns that light is reduced to
  int layer_map = 48;    // texels along a side
};

struct Refinement {
  PictureLayers found;
  double before = 0, after = 0;  // mean squared errors of I*, 0 to 255 squared
};

// What layers look like together: display values, 1 x 3 x S x S.
at::Tensor rendered(const PictureLayers& found, const MaterialRange& range, const std::vector<at::Tensor>& regions,
                    const RefinementSettings& settings = {});

Refinement refined(const PictureLayers& start, const MaterialRange& range, const at::Tensor& picture,
                   const std::vector<at::Tensor>& regions, const RefinementSettings& settings = {},
                   const Progress& progress = {});

}  // namespace partwise
