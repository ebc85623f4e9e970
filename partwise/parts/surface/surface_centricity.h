// How far out on a surface each face lies, in whatever pose: its mean distance along the surface to all of the surface,
// as a multiple of the least such mean (after the average geodesic distance of Hilaga, Shinagawa, Kohmura, Kunii 2001).
//
// 1 at the middle, 2 at the ends of a long thin rod, 1 everywhere on a sphere. Distances are lengths of paths that lead
// from the middle of a face over the middles of its sides to its neighbours. The mean is taken over samples, each with
// the area that is nearest to it as its weight: the first is the largest face, every next one is farthest from those
// before. Pieces that no edge connects are measured each by itself; pieces without a sample of their own have 1.
//
// Scale, place and order of vertices do not matter. Time O(samples x m log m).
// Errors: InputError for a mesh without a face of positive area, or without a sample.
#pragma once

#include <Eigen/Core>

#include "partwise/geometry/mesh.h"

namespace partwise {

// One value a face, at least 1.
Eigen::VectorXd surface_centricity(const Mesh& mesh, int samples = 32);

}  // namespace partwise
