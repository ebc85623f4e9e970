// Cutting a part between its convex ridges (Liu 2017, section 2.4.4.2, equations 2.9 to 2.13).
//
// Every ridge claims the faces within reach of the ends of its deep valleys, the reach being the path to the valley's
// separator (potential region, 2.9). What two ridges claim is nobody's (2.10); the rest of a claim must stay with its
// ridge (2.11), all other faces are fuzzy (2.12). Then n - 1 minimal cuts, the ridge with the smallest bounding box
// first, each separating one ridge's faces from those of all ridges still to come, over the faces that no earlier cut
// took. An edge costs 0.8 Theta / mean Theta + 0.2 length / mean length, Theta 0.3 where concave and 1 where convex
// (2.13).
#pragma once

#include <vector>

#include "partwise/parts/solid/convex_ridges.h"

namespace partwise {

// The ridge that each local face is cut off with. Faces of one ridge need not be connected.
std::vector<int> separate_ridges(const PartGraph& part, const Bridges& bridges, const ConvexRidges& ridges,
                                 double tolerance);

// The cost of cutting each shared edge (2.13).
std::vector<double> cut_costs(const PartGraph& part);

// A minimal cut of the faces: side[f] > 0 must be with the source, < 0 with the sink, 0 is free. Afterwards every face
// is 1 (reached from the source) or -1. Faces with `ignore` set are not there.
void minimal_cut(const PartGraph& part, const std::vector<double>& costs, const std::vector<char>& ignore,
                 std::vector<int>& side);

}  // namespace partwise
