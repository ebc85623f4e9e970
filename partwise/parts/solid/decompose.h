// Nearly convex decomposition of a mesh: CoRiSE, convex ridge separation (Liu 2017, section 2.4), with two measures of
// concavity. docs/decompose.md says precisely what each promises.
//
//   hull    (default) no point of any part's hull lies outside the solid by more than the tolerance. For an open mesh
//           the distance is to the surface. Certified, not sampled.
//   valley  the dissertation's: the shortest path on the part between the ends of each edge of the part's convex hull
//           is nowhere deeper below that edge than the tolerance. Paths that run on the hull itself, as a cup's rim
//           does, do not count, unless `cup_repair` finds a hollow deeper than the tolerance beneath them.
//
// Input: any triangle mesh: several components, open, non-manifold, degenerate or repeated faces, isolated vertices.
// Output: a label for every face; each part is a connected sub-mesh (connected: its faces share vertices) and has a
// convex hull with a volume that encloses all its vertices. (`max_hulls` may join parts that share no vertex.) The same
// bytes for any number of threads. Errors: InputError for a mesh with no face of positive area or a setting out of
// range; Cancelled.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

enum class ConcavityMeasure { hull, valley };

struct DecompositionSettings {
  double tolerance = 0.1;  // share of the bounding-sphere radius R of the input; model units with `absolute`
  bool absolute = false;
  ConcavityMeasure measure = ConcavityMeasure::hull;
  bool cup_repair = false;    // section 2.4.8: `valley` finds the hollows of cups too; an error with `hull`
  int max_hulls = 0;          // 0: no limit. With a limit the tolerance may be exceeded; `concavity` says by how much
  int max_hull_vertices = 0;  // 0: no limit, else at least 4; hulls are simplified from outside
};

struct Decomposition {
  std::vector<int> labels;       // of each input face, 0 .. parts - 1, parts in the order of their first face
  std::vector<Mesh> hulls;       // one a part, vertices of their own
  Mesh mesh;                     // what the parts are made of: the input, or the input with faces cut inside
  std::vector<int> mesh_labels;  // of each face of `mesh`
  bool cut_inside = false;       // faces were cut inside: `mesh` differs from the input, labels are by majority of area
  double radius = 0;             // R, model units
  double tolerance = 0;          // in the unit that was asked for
  double concavity = 0;     // upper bound of the largest of any part by the measure, in the unit that was asked for
  double volume_ratio = 0;  // volume of the union of the hulls / volume of the mesh; not a number for an open mesh
  bool watertight = false;  // closed: every edge is passed as often one way as the other
  std::map<std::string, double> seconds;  // wall time by stage

  int parts() const { return static_cast<int>(hulls.size()); }
};

Decomposition decompose(const Mesh& mesh, const DecompositionSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
