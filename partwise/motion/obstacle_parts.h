// Obstacles as worlds need them (world.h): each with the hulls of its nearly convex parts, which contact samples are
// taken from, or each part an obstacle of its own.
#pragma once

#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

struct PlanarParts {
  std::vector<Polygons> obstacles;
  std::vector<Ring> hulls;
  std::vector<int> owners;  // the obstacle of each hull
};

// By DuDe, to `tolerance` (share of a footprint's radius).
PlanarParts planar_parts(const std::vector<Polygons>& footprints, double tolerance, bool whole,
                         const Progress& progress);

struct SolidParts {
  std::vector<Mesh> obstacles;
  Mesh solid;  // all of them
  std::vector<Mesh> hulls;
  std::vector<int> owners;
};

// By CoRiSE, to `tolerance` (share of a mesh's radius). Errors: InputError of decompose.h.
SolidParts solid_parts(const std::vector<Mesh>& meshes, double tolerance, bool whole, const Progress& progress);

// One mesh of all.
Mesh joined(const std::vector<Mesh>& meshes);

}  // namespace partwise
