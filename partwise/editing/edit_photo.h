// One photo of an object in, the same object in other materials out (dissertation, sections 3.3.4 and 3.3.5).
//
// A square about the object, reduced to the networks' size, gives normals and light, and of each region, seen alone, a
// material. The new materials are then rendered with these normals, enlarged, under this light, and laid over the photo
// at its own resolution; outside the regions every pixel stays as it is. Errors: CheckFailed unless each region has one
// material.
#pragma once

#include <optional>
#include <vector>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/base/progress.h"
#include "partwise/editing/photo.h"
#include "partwise/editing/refinement.h"

namespace partwise {

// What was read off a photo.
struct PhotoLayers {
  Crop crop;
  at::Tensor picture;               // 1 x 4 x S x S, what the networks saw
  std::vector<at::Tensor> regions;  // 1 x 1 x S x S each
  PictureLayers found;              // a material a region
  double error = 0;                 // mean squared error of the picture rendered from them, 0 to 255 squared
  double error_before = 0;          // before refinement
};

struct ReadingSettings {
  bool refine = false;
  RefinementSettings refinement;
};

PhotoLayers read_layers(const EditingNetworks& networks, const Photo& photo, const ReadingSettings& settings = {},
                        const Progress& progress = {});

// The photo with its regions in the materials, under its own light or another (radiance as networks tell it: 1 shows a
// white wall white). 3 channels, or 4 where the photo has transparency; values as they are shown.
Image edited(const Photo& photo, const PhotoLayers& layers, const std::vector<DsbrdfCoefficients>& materials,
             const std::optional<EnvironmentLight>& light = {});

// The light that was found.
EnvironmentLight light_of(const PhotoLayers& layers);

}  // namespace partwise
