// Meshes changed in stated ways: with noise, and as finer meshes of the same shape.
#pragma once

#include "partwise/geometry/mesh.h"

namespace partwise::bench {

// Every vertex moved by a vector drawn evenly from the ball of radius `amplitude`, model units; or, along normals, by a
// length drawn evenly from [-amplitude, amplitude]. The same for every standard library.
Mesh noisy(Mesh mesh, double amplitude, int seed, bool along_normals);

// Edges halved until there are about `vertices`: the longest edge allowed is searched for until the number is within 1
// %, or as near as halving comes.
Mesh finer(const Mesh& mesh, int vertices);

// Moved along the normals by 0.002 R sin sin sin of the position, of a wavelength of 0.2 R: so that what was subdivided
// is not flat between the old edges. The same waves on every mesh of the shape, however fine.
Mesh rippled(Mesh mesh);

}  // namespace partwise::bench
