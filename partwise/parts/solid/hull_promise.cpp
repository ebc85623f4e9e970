#include "partwise/parts/solid/hull_promise.h"

#include "partwise/geometry/hull_simplify.h"

namespace partwise {

Mesh HullPromise::shape(const Mesh& hull) const {
  if (max_vertices_ == 0 || hull.vertices.rows() <= max_vertices_) return hull;
  return simplify_hull(hull, max_vertices_);
}

}  // namespace partwise
