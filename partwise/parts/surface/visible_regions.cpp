#include "partwise/parts/surface/visible_regions.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "partwise/parts/surface/visible_region.h"

namespace partwise {
namespace {

// Viewpoints that one thread does in a row, so that each can start from its neighbours' contours. A constant: the
// number of tests depends on it.
constexpr int kInARow = 128;

}  // namespace

std::uint64_t for_each_region(const SurfaceGraph& graph, const InnerVisibility& visibility, VisibilityMethod method,
                              const Progress& progress, const UseRegion& use) {
  tbb::enumerable_thread_specific<VisibleRegion> regions([&] { return VisibleRegion(graph, visibility); });
  SharedProgress shared(progress, "seeing", graph.size());
  const int rows = (graph.size() + kInARow - 1) / kInARow;
  tbb::parallel_for(0, rows, [&](int row) {
    VisibleRegion& region = regions.local();
    const int begin = row * kInARow, end = std::min(begin + kInARow, graph.size());
    std::vector<std::vector<std::pair<int, int>>> pairs(static_cast<std::size_t>(end - begin));
    for (int v = begin; v < end; ++v) {
      const std::vector<std::pair<int, int>>* hints = nullptr;
      for (const int w : graph.neighbours(v))
        if (w >= begin && w < v) hints = &pairs[static_cast<std::size_t>(w - begin)];
      region.find(v, method, hints);
      pairs[static_cast<std::size_t>(v - begin)] = region.edge_pairs();
      use(v, region.vertices());
    }
    shared.add(end - begin);
  });
  std::uint64_t tests = 0;
  for (const VisibleRegion& region : regions) tests += region.tests();
  return tests;
}

}  // namespace partwise
