#include "partwise/parts/planar/dual_decomposition.h"

#include <algorithm>

#include "partwise/parts/planar/candidate_cuts.h"
#include "partwise/parts/planar/complement.h"
#include "partwise/parts/planar/noise_detours.h"
#include "partwise/parts/planar/part_joining.h"
#include "partwise/parts/planar/pockets.h"

namespace partwise {
namespace {

class Decomposer {
 public:
  Decomposer(std::span<const Point2> points, const DualSettings& settings, const Progress& progress)
      : points_(points), settings_(settings), progress_(progress) {}

  std::vector<Region> decompose(const Region& whole) {
    std::vector<Region> queue{whole}, parts;
    while (!queue.empty()) {
      const Region region = std::move(queue.back());
      queue.pop_back();
      if (region_depth(points_, region) <= settings_.tolerance) {
        parts.push_back(region);
        continue;
      }
      std::vector<Region> pieces = cut(region);
      std::move(pieces.rbegin(), pieces.rend(), std::back_inserter(queue));
    }
    return join_parts(points_, std::move(parts), settings_.tolerance);
  }

  int unresolved = 0;

 private:
  // Two pieces or more.
  std::vector<Region> cut(const Region& region) {
    progress_("cutting", 0.5);
    const Complement complement = measure_complement(points_, region, settings_.tolerance,
                                                     [&](const Region& outside) { return decompose_outside(outside); });
    ChosenCuts chosen = choose_cuts(points_, region, complement, {settings_.tolerance, settings_.radius});
    if (depth_ == 0) unresolved += chosen.unresolved;
    const bool noisy = std::find(complement.noise.begin(), complement.noise.end(), true) != complement.noise.end();
    std::vector<Region> pieces =
        noisy ? split_region(points_, region, complement.noise, chosen.diagonals) : std::move(chosen.pieces);
    if (pieces.size() > 1) return pieces;
    // No resolver, or cuts that only open a ring: cut wherever the features allow it, and let joining take back.
    std::vector<int> features;
    for (const auto& [vertex, concavity] : complement.features) features.push_back(vertex);
    pieces = split_at(points_, region, features);
    return pieces.size() > 1 ? pieces : split_everywhere(points_, region);
  }

  std::vector<Region> decompose_outside(const Region& outside) {
    ++depth_;
    std::vector<Region> parts = decompose(outside);
    --depth_;
    return parts;
  }

  std::span<const Point2> points_;
  DualSettings settings_;
  const Progress& progress_;
  int depth_ = 0;  // of the recursion into the complement
};

}  // namespace

DualResult dual_decomposition(std::span<const Point2> points, const Region& region, const DualSettings& settings,
                              const Progress& progress) {
  Decomposer decomposer(points, settings, progress);
  DualResult result;
  result.parts = decomposer.decompose(region);
  result.unresolved = decomposer.unresolved;
  return result;
}

}  // namespace partwise
