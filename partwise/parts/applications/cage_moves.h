// How a user moves the vertices of a cage: a small JSON file of handles, each some vertices and what happens to them.
//
//   { "handles": [ { "vertices": [0, 7], "move": [0, 0.2, 0] },
//                  { "near": [0.5, 1, 0], "within": 0.4, "rotate": [0, 0, 1], "degrees": 30, "about": [0, 1, 0] },
//                  { "all": true, "scale": [1, 1, 0.5] } ] }
//
// A handle names its vertices by "vertices", a list of numbers from 0 in the order of the file, or by a ball ("near",
// "within", which must not be empty, by where the vertices are in the cage's file), or as "all". They are scaled
// ("scale", a number or one an axis, not 0), then turned ("rotate", an axis, counter-clockwise by "degrees" seen
// from its tip), both about the point "about" [the middle of the handle's vertices as they are by then], then moved
// ("move"). Handles act in order, on what earlier ones left. Lengths in model units.
// Errors: InputError with the file and the place for what is not so.
#pragma once

#include <filesystem>

#include "partwise/geometry/mesh.h"

namespace partwise {

// Where the vertices of the cage go.
Vertices read_cage_moves(const std::filesystem::path& path, const Mesh& cage);

}  // namespace partwise
