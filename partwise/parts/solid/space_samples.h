// Fixed sample points of the space inside the convex hull of a solid: in the solid, and in the air outside it.
//
// What hulls add to a shape is air; what they miss is solid. Both are counted on these points: the first points of a
// Halton sequence (1960) in the hull's bounding box, each standing for the same volume.
#pragma once

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/point_tree.h"
#include "partwise/geometry/surface_query.h"

namespace partwise {

struct SpaceSamples {
  PointTree air, solid;
  double volume = 0;  // that a point stands for
};

// Draws until there are `count` points in the hull, in either set. Of an open surface, the solid is what most
// directions leave through a face, a guess that holes blur; a sheet has none.
SpaceSamples sample_space(const SurfaceQuery& surface, const Mesh& hull, int count);

}  // namespace partwise
