#include "partwise/parts/planar/outline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "partwise/base/error.h"
#include "partwise/parts/planar/dual_decomposition.h"
#include "partwise/parts/planar/pockets.h"

namespace partwise {
namespace {

void append_cuts(std::span<const Point2> points, const std::vector<Region>& parts, int first,
                 std::vector<OutlineCut>& cuts) {
  std::map<IndexEdge, int> owners;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto own = [&](int a, int b) { owners[{a, b}] = static_cast<int>(p); };
    for_each_edge(parts[p].outer, own);
    for (const IndexRing& hole : parts[p].holes) for_each_edge(hole, own);
  }
  for (const auto& [edge, left] : owners) {
    const auto right = owners.find({edge.second, edge.first});
    if (edge.first > edge.second || right == owners.end()) continue;
    cuts.push_back({points[edge.first], points[edge.second], first + left, first + right->second});
  }
}

}  // namespace

int Outline::holes_noise() const {
  return static_cast<int>(
      std::count_if(holes.begin(), holes.end(), [](const OutlineHole& hole) { return hole.noise; }));
}

Outline decompose_outline(std::span<const Polygon> shape, const OutlineSettings& settings, const Progress& progress) {
  if (!(settings.tolerance > 0) || !std::isfinite(settings.tolerance)) {
    throw InputError("tolerance", "is not a number above 0", "give one, such as 0.05");
  }
  Outline result;
  result.tolerance = settings.tolerance;
  result.radius = enclosing_circle(shape).radius;
  if (!(result.radius > 0)) throw InputError("shape", "encloses nothing", "give at least one polygon");
  const double unit = settings.absolute ? 1 : result.radius;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t p = 0; p < shape.size(); ++p) {
    progress("cutting", static_cast<double>(p) / static_cast<double>(shape.size()));
    const auto [points, region] = to_region(shape[p]);
    for (std::size_t h = 0; h < region.holes.size(); ++h) {
      const double concavity = antipodal_pair(points, region.holes[h]).depth / unit;
      result.holes.push_back({static_cast<int>(p), static_cast<int>(h), concavity, concavity <= settings.tolerance});
    }
    const DualResult dual = dual_decomposition(points, region, {settings.tolerance * unit, result.radius}, progress);
    append_cuts(points, dual.parts, static_cast<int>(result.parts.size()), result.cuts);
    result.unresolved += dual.unresolved;
    for (const Region& part : dual.parts) {
      result.concavity = std::max(result.concavity, region_depth(points, part) / unit);
      result.parts.push_back(to_polygon(points, part));
    }
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.seconds.emplace_back("cutting", elapsed.count());
  return result;
}

}  // namespace partwise
