// What the page shows of shapes in the plane: clean outlines and their skeletons, one with a noisy scan of it, and a
// herd of the shipped models on one line, as crowded and as full of holes as a photograph would give it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "html.h"
#include "partwise/geometry/mesh.h"

namespace demo {

struct OutlineStory {
  double tolerance = 0;
  std::vector<Picture> clean, skeletons, noisy;
  double rand_index = 0;  // of the clean and the noisy decomposition
  int noise_holes = 0;    // that the noisy one has
  Picture herd;
};

// `herd`: the meshes to choose from.
OutlineStory tell_outlines(std::span<const partwise::Mesh* const> herd);

std::string outlines_chapter(const OutlineStory& story);
std::string outline_credits();

}  // namespace demo
