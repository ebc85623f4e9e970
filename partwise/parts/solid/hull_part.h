// A part as faces and the convex hull that encloses them.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct HullPart {
  std::vector<int> faces = {};  // of the mesh, ascending
  Mesh hull = {};  // the convex hull of the faces' vertices, and of points inside the solid that it takes in
  std::vector<int> source = {};  // for each hull vertex the mesh's vertex that it is (thickened: was moved from), or -1
  bool thickened = false;
  Vertices sketch = {};  // extreme_points() of the hull's vertices, for quick estimates
  double volume = 0;     // of the hull
};

// The points that are extreme in one of a fixed set of directions spread over the sphere: at most 96 of them.
Vertices extreme_points(const Vertices& points);

// The vertices that the faces listed use: their numbers, ascending, and where they are.
std::vector<int> vertices_of(const Mesh& mesh, const std::vector<int>& faces);
Vertices corners_of(const Mesh& mesh, const std::vector<int>& faces);

HullPart hull_part(const Mesh& mesh, std::vector<int> faces, double minimum_thickness);

// The points whose convex hull is the part's, where they were before thickening: a hull made of thickened hulls would
// be too thick and full of near-duplicates. `source` as in HullPart.
struct Corners {
  Vertices points;
  std::vector<int> source;

  void append(const Vertices& more, const std::vector<int>& their_source);
};
Corners exact_corners(const Mesh& mesh, const HullPart& part);

// The same part with the hull of these points.
void set_hull(HullPart& part, const Corners& corners, double minimum_thickness);

}  // namespace partwise
