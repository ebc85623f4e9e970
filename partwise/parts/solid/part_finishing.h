// Finishing touches on parts whose number is settled.
#pragma once

#include <vector>

#include "partwise/parts/solid/hull_part.h"
#include "partwise/parts/solid/hull_promise.h"
#include "partwise/parts/solid/space_samples.h"

namespace partwise {

// Largest hull first, every part takes over the faces of its neighbours that lie in its hull and hang together with it,
// unless the neighbour would fall apart. Its own hull stays, those of the neighbours shrink or stay: less overlap, less
// air. Parts left without a face go. Returns whether anything changed.
bool absorb_faces(const Mesh& mesh, std::vector<HullPart>& parts, double minimum_thickness);

// Hulls grow over the solid that lies in none of them, as far as the promise allows: parts of the surface leave a core
// uncovered when they close round it, as the two walls of a shell do when they belong to different parts. Each
// uncovered sample point becomes a corner (HullPart::inner) of the hull that takes in the least air for it.
void fill_interior(const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart>& parts,
                   const HullPromise& promise, double minimum_thickness);

}  // namespace partwise
