// A heap of decomposed objects, simulated with Bullet: every body is the compound of its hulls.
#pragma once

#include <span>
#include <vector>

#include "partwise/imaging/image.h"
#include "partwise/parts/solid/decompose.h"

namespace demo {

struct PileKind {  // of body
  const partwise::Mesh* mesh;
  const partwise::Decomposition* parts;
};

struct PileSettings {
  int bodies = 48;
  double seconds = 5;                           // simulated
  std::vector<double> frames{0.55, 1.05, 1.7};  // seconds at which the fall is drawn
  int width = 640, height = 480;                // pixels of those
};

struct Pile {
  std::vector<partwise::Image> frames;
  partwise::Image heap, heap_hulls;  // at the end, twice as wide: as meshes, and as the physics engine sees it
  int hulls = 0;                     // of all bodies together
  double seconds = 0;                // wall time of the simulation alone
  double fastest = 0;                // speed of the fastest body at the end, metres a second
  double deepest = 0;                // largest depth of a hull's vertex below the floor at the end, share of R
};

Pile simulate_pile(std::span<const PileKind> kinds, const PileSettings& settings = {});

}  // namespace demo
