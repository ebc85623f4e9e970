// Parts by the `hull` measure: pieces cut to about a third of the tolerance (hull_splitting.h), merged while their
// common hull stays within it (part_merging.h), finished (part_finishing.h).
//
// Cost: a part of n vertices costs O(n log n) for its hull and O(n) searches for its bridges; merging k pieces takes
// O(k log k) hulls of at most 200 points, each with a test against the octree of distances.
#pragma once

#include "partwise/base/progress.h"
#include "partwise/parts/solid/part_finishing.h"

namespace partwise {

struct HullDecompositionSettings {
  double minimum_thickness = 0;  // of hulls
  int max_hulls = 0;             // 0: no limit
};

// The mesh is centred at the origin and scaled to a bounding sphere of radius 1. Every face is in exactly one part.
std::vector<HullPart> hull_decomposition(const Mesh& mesh, const SurfaceQuery& surface, const SpaceSamples& space,
                                         OutsideDistance& outside, const HullPromise& promise,
                                         const HullDecompositionSettings& settings, const Progress& progress);

// Merges on, whatever the promise, until at most `most` parts are left.
void merge_down_to(int most, const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart>& parts,
                   double minimum_thickness, const Progress& progress);

}  // namespace partwise
