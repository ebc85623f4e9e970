// What the page shows of repair: a horse that lost faces by chance, and the watertight meshes made of what is left.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "partwise/geometry/mesh.h"
#include "partwise/parts/applications/repair.h"

namespace demo {

struct RepairStory {  // at one tolerance
  double tolerance = 0;
  int parts = 0;
  double reach = 0, seconds = 0;
  partwise::RepairLoss loss;
};

struct RepairsStory {
  double removed = 0;  // share of the faces
  std::vector<Picture> pictures;
  std::vector<RepairStory> repairs;
};

RepairsStory tell_repairs(const partwise::Mesh& horse, double azimuth);

std::string repairs_chapter(const RepairsStory& story);

}  // namespace demo
