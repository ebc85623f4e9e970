#include "partwise/parts/solid/hull_splitting.h"

#include <algorithm>

#include "partwise/parts/solid/plane_split.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

// A separation of ridges is worth it when no piece reaches outside by more than this share of what the whole did.
constexpr double kReachLeft = 0.8;

}  // namespace

std::vector<HullPart> split_to_tolerance(const Mesh& mesh, const SurfaceQuery& surface, OutsideDistance& outside,
                                         std::vector<int> faces, const SplittingSettings& settings,
                                         const Progress& progress) {
  struct Open {
    HullPart part;
    bool try_ridges;  // no separation has failed on what this was cut from
  };
  const auto parts_of = [&](std::vector<std::vector<int>> groups) {
    std::vector<HullPart> pieces;
    pieces.reserve(groups.size());
    for (auto& group : groups) pieces.push_back(hull_part(mesh, std::move(group), settings.minimum_thickness));
    return pieces;
  };
  const double total = static_cast<double>(faces.size());
  double finished = 0;
  std::vector<HullPart> done;
  std::vector<Open> open;
  open.push_back({hull_part(mesh, std::move(faces), settings.minimum_thickness), true});
  while (!open.empty()) {
    progress("splitting", finished / total);
    auto [part, try_ridges] = std::move(open.back());
    open.pop_back();
    const ConvexBody body(part.hull);
    if (part.faces.size() == 1 || outside.within(body, settings.hull_tolerance)) {
      finished += static_cast<double>(part.faces.size());
      done.push_back(std::move(part));
      continue;
    }
    const OutsideDistance::Reach reach = outside.reach(body, settings.hull_tolerance);
    std::vector<HullPart> pieces;
    if (try_ridges) {
      const double enough = std::max(settings.hull_tolerance, kReachLeft * reach.distance);
      pieces = parts_of(separate_once(mesh, surface, part.faces, settings.valley_tolerance));
      try_ridges = pieces.size() > 1 && std::all_of(pieces.begin(), pieces.end(), [&](const HullPart& piece) {
                     return outside.within(ConvexBody(piece.hull), enough);
                   });
    }
    if (!try_ridges) pieces = parts_of(split_by_plane(mesh, part.faces, reach.where, settings.minimum_thickness));
    for (HullPart& piece : pieces) open.push_back({std::move(piece), try_ridges});
  }
  return done;
}

}  // namespace partwise
