// What the page shows of repair: a horse that lost faces by chance, the hulls of the parts of what is left, and the
// watertight mesh made of them.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "partwise/geometry/mesh.h"
#include "partwise/parts/applications/repair.h"

namespace demo {

struct RepairStory {
  double removed = 0;  // share of the faces
  std::vector<Picture> pictures;
  double tolerance = 0, reach = 0, seconds = 0;
  int faces = 0;
  partwise::RepairLoss loss;
};

RepairStory tell_repair(const partwise::Mesh& horse, double azimuth);

std::string repair_chapter(const RepairStory& story);

}  // namespace demo
