// Pieces for the `hull` measure: a part is split until its hull stays within a tolerance of the solid.
//
// First between its convex ridges (Liu 2017, section 2.4), which finds the meaningful cuts. Where that only chips off
// corners, so that the largest piece is about as large as the whole was (a cup whose valleys run along its rim), by a
// plane, see plane_split.h.
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/parts/solid/hull_part.h"
#include "partwise/parts/solid/outside_distance.h"

namespace partwise {

struct SplittingSettings {
  double hull_tolerance = 0;    // the pieces' hulls hold this, model units
  double valley_tolerance = 0;  // of the ridge separation
  double minimum_thickness = 0;
};

// The faces listed are one connected group. Pieces are connected; one of a single face is kept whatever its hull.
std::vector<HullPart> split_to_tolerance(const Mesh& mesh, const SurfaceQuery& surface, OutsideDistance& outside,
                                         std::vector<int> faces, const SplittingSettings& settings,
                                         const Progress& progress);

}  // namespace partwise
