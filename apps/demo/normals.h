// What the page shows of normals of one photo: pictures of models, the normals that the network finds on them, the true
// ones, and how far apart these are.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "html.h"
#include "partwise/normals/truth/normal_measures.h"
#include "views.h"

namespace demo {

struct NormalsStory {
  std::vector<Picture> pictures;  // four a model
  partwise::NormalErrors errors;  // of all of them together
  double look_seconds = 0;        // a picture, mean
};

NormalsStory tell_normals(std::span<const WornModel> models);

std::string normals_chapter(const NormalsStory& story);

}  // namespace demo
