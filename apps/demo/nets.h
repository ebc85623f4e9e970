// What the page shows of nets: the parts of a dog as convex bodies of few faces, and these laid flat on a sheet.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "partwise/geometry/mesh.h"

namespace demo {

struct NetsStory {
  std::vector<Picture> bodies;
  Picture sheet;
  int parts = 0, nets = 0, overlaps = 0, glued = 0, without_tab = 0;
  double refolding_error = 0;  // a share of a part's radius
  double seconds = 0;          // decomposition included
};

NetsStory tell_nets(const partwise::Mesh& mesh, double azimuth);

std::string nets_chapter(const NetsStory& story);

}  // namespace demo
