// Where convex ridges show no cut, a part is cut by a plane: of thirteen planes through a point, across the principal
// axes and between them, the one whose two sides have the least total hull volume. A plane cuts the inner and the outer
// wall of a shell at the same place.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

// The two sides of the best plane through the point (faces by their centroids), each in its connected pieces. Planes
// through the middle are tried where none through the point meets the part; faces that no plane tells apart come out
// one by one. At least two pieces of two faces or more.
std::vector<std::vector<int>> split_by_plane(const Mesh& mesh, const std::vector<int>& faces, const Point& through,
                                             double minimum_thickness);

// The two sides of the plane through the middle of the faces' centroids across their longest principal axis, each in
// its connected pieces; the faces themselves where all lie on one side.
std::vector<std::vector<int>> halve(const Mesh& mesh, const std::vector<int>& faces);

}  // namespace partwise
