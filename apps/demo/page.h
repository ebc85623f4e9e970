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

struct OutlineStory {  // of shapes in the plane
  double tolerance = 0;
  std::vector<Picture> clean, skeletons, noisy;
  double rand_index = 0;  // of the clean and the noisy decomposition
  int noise_holes = 0;    // that the noisy one has
  Picture herd;
};

struct Story {
  double tolerance = 0;
  int threads = 0;
  std::vector<ModelStory> models;
  PileStory pile;
  OutlineStory outlines;
  double seconds = 0;  // of the whole run
};

Picture make_picture(const partwise::Image& image, std::string caption, std::string description);

// Of an SVG drawing, which must say its width and height.
Picture make_drawing(const std::string& svg, std::string caption, std::string description);

std::string make_page(const Story& story);

}  // namespace demo
