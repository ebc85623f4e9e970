#include "partwise/parts/solid/part_hull.h"

#include <algorithm>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

PartHull with_edges(Mesh mesh, std::vector<int> vertices) {
  PartHull hull{std::move(mesh), std::move(vertices), {}, {}};
  hull.planes = hull_planes(hull.mesh);
  hull.edges.reserve(static_cast<std::size_t>(hull.mesh.faces.rows()) * 3 / 2);
  for (const auto& f : hull.mesh.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = f[k], b = f[(k + 1) % 3];  // the hull is closed: another facet has (b, a)
      if (a < b && hull.vertices[a] != hull.vertices[b])
        hull.edges.push_back(std::minmax(hull.vertices[a], hull.vertices[b]));
    }
  }
  std::sort(hull.edges.begin(), hull.edges.end());
  hull.edges.erase(std::unique(hull.edges.begin(), hull.edges.end()), hull.edges.end());
  return hull;
}

}  // namespace

PartHull part_hull(const PartGraph& part, double tolerance) {
  ConvexHull hull = convex_hull(part.positions, kBridgeThickness * tolerance);
  return with_edges(std::move(hull.mesh), std::move(hull.source));
}

PartHull part_hull(const PartGraph& part, const Mesh& hull, std::span<const int> source) {
  std::vector<int> local;
  for (const int v : source) {
    const auto found = std::lower_bound(part.vertices.begin(), part.vertices.end(), v);
    PARTWISE_CHECK(*found, ==, v);
    local.push_back(static_cast<int>(found - part.vertices.begin()));
  }
  return with_edges(hull, std::move(local));
}

}  // namespace partwise
