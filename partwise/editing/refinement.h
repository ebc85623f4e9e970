// What networks have read off a picture, made to explain it better (dissertation, section 3.3.5): L-BFGS on
//
//   |I* - I|^2 + a |n* - n|^2 + b |L* - L|^2 + c |m* - m|^2,   a = 1, b = 10, c = 0   (3.6)
//
// over material, light and normals, one after the other, again and again. I and I* are display values, sums over the
// object's pixels and channels; normals are unit vectors, the sum is over the same pixels; light is compared by its
// logarithm, the sum over the map's pixels weighted by their solid angle (their mean weight is 1) and divided by the
// pixels there are for one of the image, so that weights mean the same at every size. Where the picture is as white as
// it can be, more light is no error.
//
// Regions have a material each; light and normals are one for all. Shapes: pictures 1 x 4 x S x S, region masks
// 1 x 1 x S x S, materials (scaled) R x 108. Errors: CheckFailed for other shapes.
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/editing/editing_networks.h"

namespace partwise {

struct RefinementSettings {
  double normal_weight = 1, light_weight = 10, material_weight = 0;
  bool normals_known = false;  // stay as they are
  int rounds = 3;
  int steps = 10;        // of L-BFGS, of each of the three a round
  int layer_light = 64;  // columns that light is reduced to
  int layer_map = 64;    // texels along a side
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
