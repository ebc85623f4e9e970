// A watertight mesh from a broken one, by way of the hulls of its parts (Liu 2017, section 2.4.7.2).
//
// The mesh, with holes, faces missing, turned or crossing, is decomposed; the surface around the union of the hulls,
// slightly expanded, is the repaired mesh. It bridges what is missing: each hull spans the holes of its part, gaps
// between hulls are sealed, and what cannot be reached from outside is filled. The price is detail: the result is as
// coarse as the tolerance.
//
// Promise: watertight, and all faces that were there lie inside. Hulls and expansion take 0.9 of the tolerance. Gaps
// between hulls are sealed as wide as the tolerance, or not where the result would stray too far for it. The hulls of
// an open mesh are a crust where it is thicker than the tolerance; what lies in it is filled where most directions meet
// the surface from inside, or nearly half of them, if faces are missing. `reach`, the largest distance of the result
// from the given surface, is certified. Where more is missing than the tolerance bridges, the crust leaks and reach
// exceeds the tolerance: whoever needs the bound looks.
//
// With a reference, the intact mesh, what was lost and added is measured: distances as certified upper bounds, volumes
// on a grid of some 10^5 points. The same bytes for any number of threads. Errors: those of decompose(); InputError for
// settings out of range and for meshes to compare that are not watertight.
#pragma once

#include <map>
#include <string>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct RepairSettings {
  double tolerance = 0.1;  // a share of the bounding-sphere radius R of the given mesh; at least 0.03
  int max_faces = 20000;   // at least 100; the surface is simplified outwards to so many
};

struct Repair {
  Mesh mesh;
  int parts = 0;
  double radius = 0;                      // R, model units
  double seal = 0;                        // half the width of gaps that were sealed beyond the expansion, a share of R
  double reach = 0;                       // of the result from the given surface, a share of R
  std::map<std::string, double> seconds;  // wall time by stage
};

Repair repair(const Mesh& mesh, const RepairSettings& settings = {}, const Progress& progress = {});

// How a repaired mesh differs from the intact one, which both must be watertight.
struct RepairLoss {
  double added = 0;         // largest distance of the repaired surface from the intact one, a share of the intact R
  double lost = 0;          // how far the intact surface reaches outside of the repaired solid, likewise
  double volume_added = 0;  // of the repaired solid outside of the intact one, as a share of the intact volume
  double volume_lost = 0;   // of the intact solid outside of the repaired one, likewise
};

RepairLoss repair_loss(const Mesh& repaired, const Mesh& intact, const Progress& progress = {});

}  // namespace partwise
