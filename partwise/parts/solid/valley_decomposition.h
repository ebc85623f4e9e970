// CoRiSE as printed: bridges, ridges, separation, repeated on every part until no valley is deep (Liu 2017,
// section 2.4).
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/parts/solid/cup_repair.h"
#include "partwise/parts/solid/part_graph.h"

namespace partwise {

// One round: the connected pieces between the ridges of the faces listed (one connected group); the faces themselves
// where no valley is deep. Deep valleys between which no cut was found are cut by a plane through the deepest point.
// Where only rims are deep (valleys that run on the hull), the pieces are taken only if the largest is less concave
// than the whole was; else cutting would nibble at the rim of a cup for ever. With the repair for cups the plane also
// cuts where ridges leave more than half of a hollow part in one piece.
std::vector<std::vector<int>> separate_once(const Mesh& mesh, const SurfaceQuery& surface,
                                            const std::vector<int>& faces, double tolerance,
                                            const CupRepair& repair = {});

// Decomposes the faces listed (one connected group) into connected groups, ascending, in the order of their first face.
// None has a valley deeper than the tolerance (model units), rims aside.
std::vector<std::vector<int>> valley_decomposition(const Mesh& mesh, const SurfaceQuery& surface,
                                                   std::vector<int> faces, double tolerance, const CupRepair& repair,
                                                   const Progress& progress);

}  // namespace partwise
