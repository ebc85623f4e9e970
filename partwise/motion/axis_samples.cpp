#include "partwise/motion/axis_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace partwise {
namespace {

constexpr std::uint64_t axis_purpose = 1;
constexpr int quick_steps = 10;

}  // namespace

double AxisSamples::share_on_axis() const {
  const auto on = std::ranges::count_if(samples, [](const AxisSample& each) { return each.state.on_axis(); });
  return samples.empty() ? 0.0 : static_cast<double>(on) / static_cast<double>(samples.size());
}

AxisSamples axis_samples(const Scene& scene, const Retractor& retract, const AxisSamplesSettings& settings,
                         const Progress& progress) {
  constexpr int batch = 4096;
  struct Found {
    Retraction walk;
    AxisState state;
    bool kept = false;
  };
  AxisSamples result;
  const auto wanted = static_cast<std::size_t>(settings.count);
  const long most = static_cast<long>(settings.most_tries) * settings.count;
  while (result.samples.size() < wanted && result.drawn < most) {
    progress("sample", static_cast<double>(result.samples.size()) / settings.count);
    // Few more than are missing, should all arrive.
    const int missing = static_cast<int>(wanted - result.samples.size());
    std::vector<std::vector<Found>> tries(static_cast<std::size_t>(std::min(batch, missing + missing / 8 + 16)));
    tbb::parallel_for(std::size_t(0), tries.size(), [&](std::size_t i) {
      Draw draw(settings.seed, static_cast<std::uint64_t>(settings.first + result.drawn) + i, axis_purpose);
      const Configuration q = settings.drawn ? settings.drawn(draw) : scene.space().drawn(draw);
      for (Retraction& walk : retract.samples(q, draw)) {
        Found& each = tries[i].emplace_back(std::move(walk));
        if (!each.walk.done || !scene.within_bounds(each.walk.q)) continue;
        each.state = axis_state(scene, each.walk.q);
        each.kept = settings.only_on_axis ? each.state.on_axis() : each.state.free;
      }
    });
    for (const auto& found : tries) {
      if (result.samples.size() == wanted) break;
      ++result.drawn;
      for (const Found& each : found) {
        result.steps += each.walk.steps;
        result.distance_queries += each.walk.distance_queries + (each.walk.done ? 1 : 0);
        result.collision_checks += each.walk.collision_checks + (each.walk.done ? 1 : 0);
        if (each.walk.done && each.walk.steps <= quick_steps) ++result.quick;
        if (each.kept && result.samples.size() < wanted)
          result.samples.push_back({each.walk.q, each.state});
        else if (!each.kept)
          ++result.lost;
      }
    }
  }
  return result;
}

}  // namespace partwise
