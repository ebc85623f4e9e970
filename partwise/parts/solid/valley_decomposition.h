// CoRiSE as printed: bridges, ridges, separation, repeated on every part until no valley is deep (Liu 2017,
// section 2.4).
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/parts/solid/cup_repair.h"
#include "partwise/parts/solid/part_graph.h"

namespace partwise {

// Connected (by vertices) groups of the faces listed, each ascending, in the order of their first face.
std::vector<std::vector<int>> connected_groups(const Mesh& mesh, const std::vector<int>& faces);

// One round: the connected pieces between the ridges of the faces listed (one connected group); the faces themselves
// where no valley is deep or no cut was found. Where only rims are deep (valleys that run on the hull), the pieces are
// taken only if the largest is less concave than the whole was; else cutting would nibble at the rim of a cup for ever.
// With the repair for cups a part with deep valleys is always cut: halved between the ends of its deepest valley where
// ridges find no cut, or leave more than half of a hollow part in one piece.
// `concavity`, if given, becomes that of the whole.
std::vector<std::vector<int>> separate_once(const Mesh& mesh, const SurfaceQuery& surface,
                                            const std::vector<int>& faces, double tolerance,
                                            const CupRepair& repair = {}, double* concavity = nullptr);

struct ValleyPart {
  std::vector<int> faces;  // global, ascending
  double concavity = 0;    // of its deepest valley, model units; above the tolerance only where no cut could be found
};

// Decomposes the faces listed (one connected group).
std::vector<ValleyPart> valley_decomposition(const Mesh& mesh, const SurfaceQuery& surface, std::vector<int> faces,
                                             double tolerance, const CupRepair& repair, const Progress& progress);

}  // namespace partwise
