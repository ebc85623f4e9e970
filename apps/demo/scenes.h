// What the page shows of pictures of rooms: what a depth sensor would tell of their normals, what the networks find
// that learnt from nothing better, and the true normals.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "html.h"
#include "partwise/normals/truth/normal_measures.h"
#include "views.h"

namespace demo {

struct ScenesStory {
  std::vector<Picture> pictures;                        // five a room
  partwise::NormalErrors sensor, standalone, combined;  // of all rooms together
};

// Furnished with these models.
ScenesStory tell_scenes(std::span<const WornModel> models);

std::string scenes_chapter(const ScenesStory& story);

}  // namespace demo
