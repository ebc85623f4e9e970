// The convex hull of a part, by the part's own vertices.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "partwise/parts/solid/part_graph.h"

namespace partwise {

struct PartHull {
  Mesh mesh;
  std::vector<int> vertices;               // for each vertex of the mesh the local vertex that it is
  std::vector<std::pair<int, int>> edges;  // local vertices, the lower first, ascending
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> planes;  // n . x <= d inside
};

constexpr double kBridgeThickness = 1e-3;  // of the tolerance: flatter parts have the hull of a plate so thick

PartHull part_hull(const PartGraph& part, double tolerance);

// From a hull that is known. source: of each of its vertices the global vertex that it is.
PartHull part_hull(const PartGraph& part, const Mesh& hull, std::span<const int> source);

}  // namespace partwise
