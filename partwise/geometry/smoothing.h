// Surfaces freed of noise, without shrinking (Taubin 1995, "A signal processing approach to fair surface design").
//
// A round moves every vertex half way to the mean of its neighbours and then a little farther back, so that bumps of a
// few edges go and what is longer than some twenty edges stays. Vertices at the same place move together. A vertex of
// the border follows its neighbours along the border alone, so that open surfaces keep their rims; vertices without an
// edge stay. Faces are as they were. The same bytes for any number of threads. Time O(rounds n).
// Errors: CheckFailed for fewer than 0 rounds.
#pragma once

#include "partwise/geometry/mesh.h"

namespace partwise {

Mesh smoothed(const Mesh& mesh, int rounds);

}  // namespace partwise
