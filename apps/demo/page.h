// The page that tells the story: one HTML file, pictures and style inside, nothing fetched from anywhere.
#pragma once

#include <string>
#include <vector>

#include "models.h"
#include "pile.h"

namespace demo {

struct Picture {
  std::string data;  // a data: address
  std::string caption, description;
  int width = 0, height = 0;  // pixels
};

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

struct Story {
  double tolerance = 0;
  int threads = 0;
  std::vector<ModelStory> models;
  PileStory pile;
  double seconds = 0;  // of the whole run
};

Picture make_picture(const partwise::Image& image, std::string caption, std::string description);

std::string make_page(const Story& story);

}  // namespace demo
