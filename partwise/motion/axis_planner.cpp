#include "partwise/motion/axis_planner.h"

#include <algorithm>
#include <utility>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr std::uint64_t end_purpose = 3, plain_purpose = 4;

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

void AxisPlanner::grow(const Progress& progress) {
  const int count = std::max(settings_.batch, static_cast<int>(growing_.samples().size() / 4));
  const int plain = static_cast<int>(settings_.free_share * count);
  AxisSamplesSettings sampling{.count = count - plain, .only_on_axis = settings_.only_on_axis, .seed = settings_.seed};
  sampling.first = drawn_;
  AxisSamples found = axis_samples(scene_, retract_, sampling, progress);
  drawn_ += found.drawn;
  std::vector<AxisSample> samples = std::exchange(waiting_, {});
  std::ranges::move(found.samples, std::back_inserter(samples));
  std::ranges::move(plain_samples(plain), std::back_inserter(samples));
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

std::optional<MotionPath> AxisPlanner::path() const {
  return path_search(growing_.roadmap(), growing_.samples(), starts_, goals_, settings_.search);
}

MotionPath AxisPlanner::solve(const Progress& progress) {
  join_ends(progress);
  while (true) {
    if (std::optional<MotionPath> found = path()) return *std::move(found);
    grow(progress);
  }
}

}  // namespace partwise
