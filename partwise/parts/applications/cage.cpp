#include "partwise/parts/applications/cage.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/hull_contour.h"
#include "partwise/geometry/hull_simplify.h"
#include "partwise/geometry/outward_simplify.h"
#include "partwise/geometry/topology.h"
#include "partwise/geometry/triangle_crossing.h"
#include "partwise/parts/solid/decompose.h"

namespace partwise {
namespace {

void check(const CageSettings& settings) {
  if (settings.max_faces < 4)
    throw InputError("max_faces", fmt::format("{} faces enclose nothing", settings.max_faces), "ask for 4 or more");
  if (!(settings.expansion >= 0.005 && settings.expansion <= 1))
    throw InputError("expansion", fmt::format("{} is out of range", settings.expansion), "give 0.005 to 1");
}

bool is_cage_of(const Mesh& cage, const Mesh& mesh, int max_faces) {
  return cage.faces.rows() <= max_faces && is_watertight(cage) && !crosses_itself(cage) && encloses(cage, mesh);
}

// The convex hull with few vertices, and a little larger, so that the mesh does not touch it. A closed convex surface
// of n vertices has 2 n - 4 faces.
Mesh convex_cage(const Mesh& mesh, double expansion, int max_faces) {
  Mesh hull = simplify_hull(convex_hull(mesh.vertices, expansion).mesh, (max_faces + 4) / 2);
  const Point centre = hull.vertices.colwise().mean();
  const auto planes = hull_planes(hull);
  const double inradius = (planes.col(3) - planes.leftCols<3>() * centre.transpose()).minCoeff();
  PARTWISE_CHECK(inradius, >, 0);
  hull.vertices = (((hull.vertices.rowwise() - centre) * (1 + expansion / inradius)).rowwise() + centre).eval();
  return hull;
}

Mesh union_cage(const Mesh& mesh, const std::vector<Mesh>& hulls, double radius, const CageSettings& settings,
                double& expansion) {
  for (; expansion <= 1; expansion *= 2) {
    const double distance = expansion * radius;
    Mesh cage =
        simplify_outwards(hull_contour(hulls, {.distance = distance, .spacing = distance / 1.1}), settings.max_faces);
    if (is_cage_of(cage, mesh, settings.max_faces)) return cage;
  }
  Mesh cage = convex_cage(mesh, settings.expansion * radius, settings.max_faces);
  PARTWISE_CHECK(is_cage_of(cage, mesh, settings.max_faces), ==, true);
  return cage;
}

}  // namespace

Cage make_cage(const Mesh& mesh, const CageSettings& settings, const Progress& progress) {
  check(settings);
  const Decomposition parts = decompose(mesh, {.tolerance = settings.tolerance}, progress);
  progress("cage", 0);
  const auto start = std::chrono::steady_clock::now();
  Cage cage;
  cage.parts = parts.parts();
  cage.radius = parts.radius;
  cage.expansion = settings.expansion;
  cage.mesh = union_cage(mesh, parts.hulls, parts.radius, settings, cage.expansion);
  cage.volume = signed_volume(cage.mesh);
  cage.seconds = parts.seconds;
  cage.seconds["cage"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return cage;
}

}  // namespace partwise
