// A cage: a coarse closed surface around a mesh, by whose vertices the mesh is deformed (Liu 2017, section 2.4.7.1).
//
// The mesh is decomposed; the hulls of its parts are expanded, their union is contoured (hull_contour.h) and simplified
// outwards (outward_simplify.h) to the number of faces that was asked for. So the cage follows the parts: it has an arm
// where the mesh has one. Where the expanded hulls of two parts meet across a gap the cage closes it.
//
// Promise: the cage is watertight, does not cross itself, no face of the mesh crosses a face of the cage, all of the
// mesh lies inside, and it has at most max_faces faces; all but the number is tested on the result with double
// precision. Where a union cannot be had with so few faces (many thin rings), the expansion is doubled until it can; in
// the end it is the mesh's convex hull. The same bytes for any number of threads.
// Errors: those of decompose(); InputError for max_faces below 4 or an expansion out of range.
#pragma once

#include <map>
#include <string>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct CageSettings {
  double tolerance = 0.1;   // of the decomposition, a share of the bounding-sphere radius R
  double expansion = 0.04;  // how far the hulls are expanded, a share of R; from 0.005 to 1
  int max_faces = 300;      // at least 4
};

struct Cage {
  Mesh mesh;
  int parts = 0;
  double radius = 0;                      // R, model units
  double expansion = 0;                   // that it took, a share of R
  double volume = 0;                      // enclosed, model units cubed
  std::map<std::string, double> seconds;  // wall time by stage
};

Cage make_cage(const Mesh& mesh, const CageSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
