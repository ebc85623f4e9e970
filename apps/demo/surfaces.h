// What the page shows of features of surfaces: maps of four features side by side, the parts that come from each, and
// points of the medial axis.
#pragma once

#include <span>

#include "models.h"
#include "page.h"
#include "partwise/geometry/mesh.h"

namespace demo {

struct ShownModel {
  const Model* model;
  const partwise::Mesh* mesh;
};

// `models`: to choose from.
SurfacesStory tell_surfaces(std::span<const ShownModel> models);

}  // namespace demo
