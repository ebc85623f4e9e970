// The page that tells the story: one HTML file, pictures and style inside, nothing fetched from anywhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "html.h"
#include "models.h"
#include "pile.h"

namespace demo {

struct Figures {  // of one decomposition
  int parts = 0;
  double concavity = 0, volume_ratio = 0, seconds = 0;  // concavity as a share of R; ratio not a number if open
};

struct ModelStory {
  Model model;
  int faces = 0;
  bool watertight = false;
  std::vector<Picture> pictures;  // from the input to the hulls
  Figures hull, valley;           // by measure
};

struct PileStory {
  int bodies = 0, hulls = 0;
  double simulated = 0, seconds = 0, deepest = 0;
  std::vector<Picture> falling;
  Picture heap, heap_hulls;
};

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

struct OutlineStory {  // of shapes in the plane
  double tolerance = 0;
  std::vector<Picture> clean, skeletons, noisy;
  double rand_index = 0;  // of the clean and the noisy decomposition
  int noise_holes = 0;    // that the noisy one has
  Picture herd;
};

struct OtherPage {
  std::string_view file, title;
};

struct Story {
  double tolerance = 0;
  int threads = 0;
  std::vector<ModelStory> models;
  PileStory pile;
  SurfacesStory surfaces;
  OutlineStory outlines;
  std::vector<OtherPage> others;
  double seconds = 0;  // of the whole run
};

std::string make_page(const Story& story);

}  // namespace demo
