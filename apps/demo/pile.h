// A heap of decomposed objects, simulated with Bullet: every body is the compound of its hulls.
#pragma once

#include <span>
#include <vector>

#include "partwise/appearance/preview.h"
#include "partwise/parts/solid/decompose.h"

namespace demo {

struct PileKind {  // of body
  const partwise::Mesh* mesh;
  const partwise::Decomposition* parts;
};

struct PileSettings {
  int bodies = 48;                          // released four at a time
  double interval = 0.45;                   // seconds between releases
  double seconds = 9;                       // simulated
  std::vector<double> frames{1.6, 3.2, 5};  // seconds at which the fall is drawn
  int width = 480, height = 440;            // pixels of those
  int heap_width = 1280, heap_height = 480;
};

struct Pile {                                   // as simulated
  std::vector<partwise::PreviewScene> falling;  // at the times of the frames
  partwise::PreviewScene heap, heap_hulls;      // at the end: as meshes, and as the physics engine sees it
  int hulls = 0;                                // of all bodies together
  double seconds = 0;                           // of one core
  double deepest = 0;                           // of a hull's vertex below the floor at the end, share of R; 0 if none
};

Pile simulate_pile(std::span<const PileKind> kinds, const PileSettings& settings = {});

struct PilePictures {
  std::vector<partwise::Image> falling;
  partwise::Image heap, heap_hulls;
};

PilePictures draw_pile(const Pile& pile, const PileSettings& settings = {});

}  // namespace demo
