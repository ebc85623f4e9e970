#include "partwise/parts/solid/hull_decomposition.h"

#include <numeric>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/hull_splitting.h"
#include "partwise/parts/solid/part_merging.h"
#include "partwise/parts/solid/plane_split.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

constexpr double kPieceTolerance = 0.35;  // of the tolerance: what pieces are cut to, so that merging has room
constexpr double kLargestAir = 7;         // see largest_air()

// Parts that break the promise once their hulls are simplified are cut until they keep it.
void keep_promise(const Mesh& mesh, const HullPromise& promise, std::vector<HullPart>& parts,
                  double minimum_thickness) {
  for (std::size_t p = 0; p < parts.size();) {
    if (parts[p].faces.size() == 1 || promise.holds(parts[p].hull)) {
      ++p;
      continue;
    }
    std::vector<std::vector<int>> groups =
        split_by_plane(mesh, parts[p].faces, promise.reach(parts[p].hull).where, minimum_thickness);
    parts[p] = hull_part(mesh, std::move(groups.front()), minimum_thickness);
    for (std::size_t g = 1; g < groups.size(); ++g)
      parts.push_back(hull_part(mesh, std::move(groups[g]), minimum_thickness));
  }
}

}  // namespace

std::vector<HullPart> hull_decomposition(const Mesh& mesh, const SurfaceQuery& surface, const SpaceSamples& space,
                                         OutsideDistance& outside, const HullPromise& promise,
                                         const HullDecompositionSettings& settings, const Progress& progress) {
  std::vector<int> all(static_cast<std::size_t>(mesh.faces.rows()));
  std::iota(all.begin(), all.end(), 0);
  const double piece_tolerance = kPieceTolerance * promise.tolerance();
  std::vector<HullPart> parts;
  for (auto& group : connected_groups(mesh, all)) {
    const SplittingSettings splitting{piece_tolerance, piece_tolerance, settings.minimum_thickness};
    for (HullPart& piece : split_to_tolerance(mesh, surface, outside, std::move(group), splitting, progress))
      parts.push_back(std::move(piece));
  }
  keep_promise(mesh, promise, parts, settings.minimum_thickness);

  const AcceptMerge accept = [&](const HullPart& merged) { return promise.holds(merged.hull); };
  const MergeSettings merging{settings.minimum_thickness, largest_air(space, promise.tolerance(), kLargestAir)};
  {
    PartMerging merge(mesh, space, std::move(parts), accept, merging);
    do merge.merge(progress);
    while (merge.dissolve(progress) > 0);
    merge.refine();
    while (merge.dissolve(progress) > 0) merge.merge(progress);
    parts = merge.parts();
  }
  if (absorb_faces(mesh, parts, settings.minimum_thickness)) {
    PartMerging merge(mesh, space, std::move(parts), accept, merging);
    merge.merge(progress);
    parts = merge.parts();
    keep_promise(mesh, promise, parts, settings.minimum_thickness);
  }
  fill_interior(mesh, space, parts, promise, settings.minimum_thickness);
  keep_promise(mesh, promise, parts, settings.minimum_thickness);
  if (settings.max_hulls > 0)
    merge_down_to(settings.max_hulls, mesh, space, parts, settings.minimum_thickness, progress);
  return parts;
}

void merge_down_to(int most, const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart>& parts,
                   double minimum_thickness, const Progress& progress) {
  const AcceptMerge any = [](const HullPart&) { return true; };
  for (const bool connect : {false, true}) {  // Parts that share no vertex only where nothing else is left.
    if (static_cast<int>(parts.size()) <= most) return;
    PartMerging merge(mesh, space, std::move(parts), any, {.minimum_thickness = minimum_thickness});
    if (connect) merge.connect_all();
    merge.merge(progress, most);
    parts = merge.parts();
  }
}

}  // namespace partwise
