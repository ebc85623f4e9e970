#include "partwise/parts/applications/repair.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/farthest_point.h"
#include "partwise/geometry/hull_contour.h"
#include "partwise/geometry/outward_simplify.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/decompose.h"

namespace partwise {
namespace {

// Where the tolerance goes: to the expansion, and to the hulls what remains of this share of it.
constexpr double for_both = 0.9, for_expansion = 0.16;
constexpr double least_expansion = 0.01;  // a share of R: finer grids cost more than they show
constexpr double seals[] = {0.5, 0};      // shares of the tolerance, tried in turn
constexpr double doubt = 0.1;  // a share of R: through gaps narrower than twice that the outside is not believed
constexpr double open_winding = 0.25;  // about half of what a mesh without half of its faces has inside
constexpr double precision = 2e-3;     // of distances, a share of R
constexpr int samples = 48;            // along the longest side of the box that both solids share, for volumes

void check(const RepairSettings& settings) {
  if (!(settings.tolerance >= 0.03 && settings.tolerance <= 1))
    throw InputError("tolerance", fmt::format("{} is out of range", settings.tolerance), "give 0.03 to 1");
  if (settings.max_faces < 100)
    throw InputError("max_faces", fmt::format("{} is less than 100", settings.max_faces), "ask for 100 or more");
}

}  // namespace

Repair repair(const Mesh& mesh, const RepairSettings& settings, const Progress& progress) {
  check(settings);
  const double expansion = std::max(for_expansion * settings.tolerance, least_expansion);
  const Decomposition parts = decompose(mesh, {.tolerance = for_both * settings.tolerance - expansion}, progress);
  progress("skin", 0);
  const auto start = std::chrono::steady_clock::now();
  Repair result;
  result.parts = parts.parts();
  result.radius = parts.radius;
  result.seconds = parts.seconds;
  const SurfaceQuery given(mesh);
  // Open meshes show less than a whole number: of the directions from inside, those that no face is missing from.
  const double least_winding = parts.watertight ? 0.5 : open_winding;
  ContourSettings contour{.distance = expansion * parts.radius,
                          .spacing = expansion * parts.radius,
                          .is_solid = [&](const Point& p) { return given.winding_number(p) > least_winding; },
                          .doubt = doubt * parts.radius};
  result.reach = std::numeric_limits<double>::infinity();
  for (const double seal : seals) {
    contour.seal = seal * settings.tolerance * parts.radius;
    Mesh skin = simplify_outwards(hull_contour(parts.hulls, contour), settings.max_faces);
    const auto to_given = [&](const Point& p) { return given.distance(p); };
    const double reach = farthest_point(skin, to_given, precision * parts.radius) / parts.radius;
    if (reach >= result.reach) continue;
    result.mesh = std::move(skin);
    result.seal = seal * settings.tolerance;
    result.reach = reach;
    if (reach <= settings.tolerance) break;
  }
  PARTWISE_CHECK(is_watertight(result.mesh), ==, true);
  result.seconds["skin"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

RepairLoss repair_loss(const Mesh& repaired, const Mesh& intact, const Progress& progress) {
  if (!is_watertight(intact)) throw InputError("reference", "is not watertight", "give the intact mesh");
  if (!is_watertight(repaired)) throw InputError("repaired", "is not watertight", "give what repair made");
  const SurfaceQuery before(intact), after(repaired);
  const double radius = bounding_sphere(intact).radius;
  RepairLoss loss;
  const auto farthest = [&](const Mesh& surface, double done, const auto& distance) {
    const auto asked = [&](const Point& p) {
      progress("distances", done);
      return distance(p);
    };
    return farthest_point(surface, asked, precision * radius) / radius;
  };
  loss.added = farthest(repaired, 0, [&](const Point& p) { return before.distance(p); });
  loss.lost = farthest(intact, 0.5, [&](const Point& p) { return after.contains(p) ? 0 : after.distance(p); });
  const auto extent = [&](bool high) -> Point {
    return high ? Point(intact.vertices.colwise().maxCoeff().cwiseMax(repaired.vertices.colwise().maxCoeff()))
                : Point(intact.vertices.colwise().minCoeff().cwiseMin(repaired.vertices.colwise().minCoeff()));
  };
  const Point low = extent(false), size = extent(true) - low;
  const double step = size.maxCoeff() / samples;
  const Eigen::Array3i count = (size.transpose() / step).array().ceil().cast<int>();
  struct Counts {
    long both = 0, before = 0, after = 0;
  };
  std::vector<Counts> layers(static_cast<std::size_t>(count[2]));
  SharedProgress shared(progress, "volumes", count[2]);
  tbb::parallel_for(0, count[2], [&](int k) {
    Counts& layer = layers[static_cast<std::size_t>(k)];
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const Point p = low + step * Point(i + 0.5, j + 0.5, k + 0.5);
        const bool was = before.contains(p), is = after.contains(p);
        layer.both += was && is;
        layer.before += was;
        layer.after += is;
      }
    shared.add(1);
  });
  Counts all;
  for (const Counts& layer : layers) all.both += layer.both, all.before += layer.before, all.after += layer.after;
  const double solid = std::max(1.0, static_cast<double>(all.before));
  loss.volume_added = static_cast<double>(all.after - all.both) / solid;
  loss.volume_lost = static_cast<double>(all.before - all.both) / solid;
  return loss;
}

}  // namespace partwise
