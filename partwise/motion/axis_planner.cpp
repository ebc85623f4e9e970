#include "partwise/motion/axis_planner.h"

#include <algorithm>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/motion/reached_region.h"

namespace partwise {
namespace {

constexpr std::uint64_t end_purpose = 3, plain_purpose = 4;
constexpr long first_near = 1L << 40;  // number of a configuration, past all that are drawn evenly

RoadmapSettings seeded(RoadmapSettings settings, std::uint64_t seed) {
  settings.seed = seed;
  return settings;
}

}  // namespace

AxisPlanner::AxisPlanner(const Scene& scene, const Retractor& retract, const AxisPlannerSettings& settings)
    : scene_(scene),
      retract_(retract),
      settings_(settings),
      growing_(scene, retract, seeded(settings.connecting, settings.seed)) {}

int AxisPlanner::add_end(const Configuration& q) {
  PARTWISE_CHECK(scene_.within_bounds(q) && scene_.free(q), ==, true);
  const int number = growing_.add_endpoint(q);
  Draw draw(settings_.seed, static_cast<std::uint64_t>(number), end_purpose);
  const Retraction pushed = retract_(q, draw);
  if (pushed.done && scene_.within_bounds(pushed.q) && scene_.free(pushed.q))
    waiting_.push_back({pushed.q, axis_state(scene_, pushed.q)});
  joined_ = false;
  return number;
}

std::vector<AxisSample> AxisPlanner::plain_samples(int count) {
  std::vector<AxisSample> samples;
  for (int tries = 0; tries < 20 * count && std::ssize(samples) < count; ++tries) {
    Draw draw(settings_.seed, static_cast<std::uint64_t>(plain_drawn_++), plain_purpose);
    const Configuration q = scene_.space().drawn(draw);
    if (scene_.within_bounds(q) && scene_.free(q)) samples.push_back({q, axis_state(scene_, q)});
  }
  return samples;
}

std::vector<AxisSample> AxisPlanner::even_samples(int count, const Progress& progress) {
  AxisSamplesSettings sampling{.count = count, .only_on_axis = settings_.only_on_axis, .seed = settings_.seed};
  sampling.first = drawn_;
  AxisSamples found = axis_samples(scene_, retract_, sampling, progress);
  drawn_ += found.drawn;
  return std::move(found.samples);
}

std::vector<AxisSample> AxisPlanner::near_samples(int count, const Progress& progress) {
  std::vector<int> ends = starts_;
  ends.insert(ends.end(), goals_.begin(), goals_.end());
  if (ends.empty() || count == 0) return {};
  const ReachedRegion reached(scene_, growing_.samples(), growing_.roadmap(), ends, old_);
  AxisSamplesSettings sampling{.count = count, .only_on_axis = settings_.only_on_axis, .seed = settings_.seed};
  sampling.first = first_near + near_drawn_;
  sampling.drawn = [&](Draw& draw) { return reached.drawn(draw); };
  AxisSamples found = axis_samples(scene_, retract_, sampling, progress);
  near_drawn_ += found.drawn;
  return std::move(found.samples);
}

void AxisPlanner::grow(const Progress& progress) {
  const int count = std::max(settings_.batch, static_cast<int>(growing_.samples().size() / 32));
  const int plain = static_cast<int>(settings_.free_share * count);
  const int near = drawn_ == 0 ? 0 : static_cast<int>(settings_.near_share * (count - plain));
  std::vector<AxisSample> samples = even_samples(count - plain - near, progress);
  const auto take = [&](std::vector<AxisSample> more) { std::ranges::move(more, std::back_inserter(samples)); };
  take(near_samples(near, progress));
  take(plain_samples(plain));
  take(std::exchange(waiting_, {}));
  old_ = growing_.samples().size();
  growing_.add(samples, progress);
  joined_ = true;
}

void AxisPlanner::forget_ends() {
  starts_.clear();
  goals_.clear();
}

void AxisPlanner::join_ends(const Progress& progress) {
  if (joined_) return;
  growing_.add(std::exchange(waiting_, {}), progress);
  joined_ = true;
}

std::optional<MotionPath> AxisPlanner::path(const Progress& progress) {
  const auto best = [&] {
    return path_search(growing_.roadmap(), growing_.samples(), starts_, goals_, settings_.search);
  };
  std::optional<MotionPath> found = best();
  try {
    while (found && growing_.add_cycles(*found, progress)) found = best();
  } catch (const Cancelled&) {  // no time to find a better one
  }
  return found;
}

MotionPath AxisPlanner::solve(const Progress& progress) {
  join_ends(progress);
  while (true) {
    if (std::optional<MotionPath> found = path(progress)) return *std::move(found);
    grow(progress);
  }
}

}  // namespace partwise
