// What the page shows of cages: a horse in its cage, the cage moved in several ways, and the horse that went with it.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "partwise/geometry/mesh.h"
#include "turnable.h"

namespace demo {

struct CagesStory {
  Turnable horse;  // from rest to the first deformation
  std::vector<Picture> deformed;
  int faces = 0, cage_faces = 0;
  double cage_seconds = 0;    // decomposition included
  double weigh_seconds = 0;   // coordinates, once
  double move_seconds = 0;    // a deformation, mean
  double identity_error = 0;  // of a cage that stays, a share of R
};

CagesStory tell_cages(const partwise::Mesh& horse, double azimuth);

std::string cages_chapter(const CagesStory& story);

}  // namespace demo
