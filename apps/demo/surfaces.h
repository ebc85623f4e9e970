// What the page shows of features of surfaces: maps of four features side by side, the parts that come from each, and
// points of the medial axis.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "html.h"
#include "models.h"
#include "partwise/geometry/mesh.h"

namespace demo {

struct FeatureStory {  // of one feature on one model
  std::string name;
  Picture map, parts;
  std::uint64_t tests = 0;  // of visibility
  int part_count = 0;
  double seconds = 0;  // of the values and the cut
};

struct SurfaceStory {  // of one model
  std::string_view name;
  int vertices = 0;
  std::vector<FeatureStory> features;
};

struct SurfacesStory {
  std::vector<SurfaceStory> models;
  std::vector<Picture> medial;
};

struct ShownModel {
  const Model* model;
  const partwise::Mesh* mesh;
};

// `models`: to choose from.
SurfacesStory tell_surfaces(std::span<const ShownModel> models);

std::string surfaces_chapter(const SurfacesStory& story);

}  // namespace demo
