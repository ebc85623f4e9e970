#include "partwise/parts/surface/weak_visibility.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <vector>

namespace partwise {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// One viewpoint at a time; keeps its arrays from one to the next.
class WeakSearch {
 public:
  WeakSearch(const SurfaceGraph& graph, const InnerVisibility& visibility, double threshold)
      : graph_(graph), visibility_(visibility), threshold_(threshold), at_(static_cast<std::size_t>(graph.size())) {}

  // Ascending.
  std::vector<int> region(int viewpoint) {
    std::fill(at_.begin(), at_.end(), Vertex{});
    std::vector<int> seen;
    at_[viewpoint] = {.distance = 0, .hidden = 0, .done = false, .visible = true, .parent = viewpoint};
    Queue queue;
    queue.emplace(0, viewpoint);
    std::size_t open = 1;  // queued vertices that may still be within the threshold
    while (!queue.empty() && open > 0) {
      const auto [distance, v] = queue.top();
      queue.pop();
      Vertex& here = at_[v];
      const bool hopeful = at_[here.parent].hidden <= threshold_;
      if (here.done || distance > here.distance) continue;
      here.done = true;
      open -= hopeful;
      settle(viewpoint, v, hopeful);
      if (here.visible && here.hidden <= threshold_) seen.push_back(v);
      for (const int w : graph_.neighbours(v)) {
        Vertex& next = at_[w];
        const double through = here.distance + length(v, w);
        if (next.done || through >= next.distance) continue;
        if (next.distance < kFar) open -= at_[next.parent].hidden <= threshold_;
        open += here.hidden <= threshold_;
        next.distance = through;
        next.parent = v;
        queue.emplace(through, w);
      }
    }
    std::sort(seen.begin(), seen.end());
    return seen;
  }

  std::uint64_t tests() const { return tests_; }

 private:
  using Queue = std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>;
  struct Vertex {
    double distance = kFar, hidden = kFar;  // of the path to it, and of that the hidden length
    bool done = false, visible = false;
    int parent = 0;
  };

  double length(int v, int w) const { return (graph_.mesh.vertices.row(v) - graph_.mesh.vertices.row(w)).norm(); }

  void settle(int viewpoint, int v, bool hopeful) {
    Vertex& here = at_[v];
    if (v == viewpoint || !hopeful) return;
    ++tests_;
    here.visible = visibility_.sees(viewpoint, v);
    const Vertex& before = at_[here.parent];
    here.hidden = before.hidden + length(v, here.parent) * ((before.visible ? 0 : 0.5) + (here.visible ? 0 : 0.5));
  }

  const SurfaceGraph& graph_;
  const InnerVisibility& visibility_;
  double threshold_;
  std::vector<Vertex> at_;
  std::uint64_t tests_ = 0;
};

}  // namespace

VisibilityMatrix weak_regions(const SurfaceGraph& graph, const InnerVisibility& visibility, double threshold,
                              const Progress& progress, std::uint64_t& tests) {
  VisibilityMatrix sees(graph.size());
  tbb::enumerable_thread_specific<WeakSearch> searches([&] { return WeakSearch(graph, visibility, threshold); });
  SharedProgress shared(progress, "seeing", graph.size());
  tbb::parallel_for(0, graph.size(), [&](int v) {
    sees.set_row(v, searches.local().region(v));
    shared.add(1);
  });
  tests = 0;
  for (const WeakSearch& search : searches) tests += search.tests();
  return sees;
}

}  // namespace partwise
