#include "partwise/parts/solid/decompose.h"

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"

namespace partwise {

Decomposition decompose(const Mesh& mesh, const DecompositionSettings& settings, const Progress& progress) {
  progress("hull", 0);
  Decomposition result;
  result.labels.assign(static_cast<std::size_t>(mesh.faces.rows()), 0);
  result.mesh = mesh;
  result.mesh_labels = result.labels;
  result.radius = bounding_sphere(mesh).radius;
  result.tolerance = settings.tolerance;
  result.hulls.push_back(convex_hull(mesh.vertices, 1e-4 * result.radius).mesh);
  return result;
}

}  // namespace partwise
