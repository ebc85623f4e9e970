// A finer mesh of the same surface: edges longer than a bound are halved, at the same point in all their faces, until
// none is longer. Closed stays closed; no vertex moves; new vertices lie on old edges. Linear in the faces that come
// out. Errors: InputError when more than `most_faces` would come out.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct Subdivision {
  Mesh mesh;                // the input's vertices come first
  std::vector<int> parent;  // the input face of each face
};

Subdivision split_long_edges(const Mesh& mesh, double longest, int most_faces);

}  // namespace partwise
