// A closed surface around convex polyhedra, at a distance: the outline of their expanded union, for cages and repair.
//
// The distance of a point from a polyhedron is taken as that to its farthest facet plane, with 26 further planes of
// support that bevel its corners: a convex function that equals the Euclidean distance above a facet, is at most that
// elsewhere, and at least 0.88 of it. The union's is the least of all. It is sampled on a grid and contoured by
// marching cubes (Lorensen, Cline 1987) whose loops are derived face by face, so that neighbouring cubes always agree:
// where a face of a cube has two inside corners across from each other, they are kept apart.
//
// Output: a closed manifold mesh, counter-clockwise from outside, that does not cross itself. Space that cannot be
// reached from far away counts as inside, so that there are no bubbles, and hulls that leave gaps narrower than twice
// the distance still give one skin. With `seal` gaps narrower than twice distance + seal are closed too, the skin
// leading across them not far inside, and elsewhere it stays where it was. Vertices lie within spacing / 2 of the asked
// distance but where gaps are closed. A distance of at least one spacing keeps the surface outside of the hulls but for
// rare cases; a distance of 1.37 spacings does so always.
// The same bytes for any number of threads. Time O(blocks of the grid times facets) and O(grid).
//
// Hulls must be closed, convex, counter-clockwise from outside. Lengths in model units. Errors: InputError for no hull,
// a distance or spacing that is not positive, a negative seal or doubt, and a grid of more than 2^27 samples.
#pragma once

#include <functional>
#include <span>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct ContourSettings {
  double distance = 0;
  double spacing = 0;  // of the grid
  double seal = 0;     // half the width beyond 2 x distance of gaps to be closed
  // What else is solid, asked only of places between the hulls that are reached through gaps narrower than twice
  // distance + doubt alone, and believed where more than half of seven neighbouring samples agree. May run in parallel.
  std::function<bool(const Point&)> is_solid{};
  double doubt = 0;
};

Mesh hull_contour(std::span<const Mesh> hulls, const ContourSettings& settings);

}  // namespace partwise
