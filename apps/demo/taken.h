// Pictures of models as a camera would have taken them, and what there is behind them.
#pragma once

#include <string>
#include <vector>

#include "partwise/editing/photo.h"
#include "views.h"

namespace demo {

struct Taken {
  partwise::GBuffer seen;
  partwise::EnvironmentLight light;
  std::vector<std::string> materials;  // a part
  float exposure = 0;
  partwise::Photo photo;
};

// Of 320 x 320 pixels on light ground. Its regions are the parts, one material each, or all of it.
Taken taken(const WornModel& model, const std::vector<std::string>& materials, const std::string& light, double azimuth,
            bool parts_apart = false);

// What is shown of an object on that ground, exposed as a camera would expose it: by the object's median.
partwise::Image exposed_anew(const partwise::Image& shown, const partwise::Image& mask);

WornModel whole(WornModel model);  // in one part

}  // namespace demo
