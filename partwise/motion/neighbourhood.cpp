#include "partwise/motion/neighbourhood.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "partwise/motion/sample_tree.h"

namespace partwise {
namespace {

constexpr std::uint64_t probe_purpose = 0;
constexpr int fewest_probes = 20000, probes_an_obstacle = 100;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<SampleTree::Pair> probed(const ConfigurationSpace& space, const ContactSamples& samples,
                                     std::uint64_t seed) {
  const SampleTree tree(samples);
  const auto points = static_cast<std::size_t>(samples.size());
  const auto probes = static_cast<std::size_t>(std::max(fewest_probes, probes_an_obstacle * samples.count));
  std::vector<SampleTree::Pair> seen(points + probes);
  tbb::parallel_for(std::size_t(0), seen.size(), [&](std::size_t i) {
    MotionVector x;
    if (i < points) {
      x = samples.points.row(static_cast<Eigen::Index>(i)).transpose();
      x = (x + samples.points.row(tree.nearest_other(x, samples.obstacles[i]).sample).transpose()) / 2;
    } else {
      Draw draw(seed, i - points, probe_purpose);
      x = space.embedded(space.drawn(draw));
    }
    seen[i] = tree.nearest_two(x);
  });
  return seen;
}

}  // namespace

ObstaclePair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

Neighbourhood neighbourhood(const ConfigurationSpace& space, const ContactSamples& samples, std::uint64_t seed) {
  Neighbourhood result;
  result.neighbours.resize(static_cast<std::size_t>(samples.count));
  result.reaches.resize(result.neighbours.size());
  std::map<ObstaclePair, std::vector<double>> distances;
  for (const SampleTree::Pair& each : probed(space, samples, seed)) {
    distances[ordered(each.nearest, each.second)].push_back(each.distance + each.second_distance);
    double &nearest = result.reaches[static_cast<std::size_t>(each.nearest)],
           &second = result.reaches[static_cast<std::size_t>(each.second)];
    nearest = std::max(nearest, each.distance);
    second = std::max(second, each.second_distance);
  }
  for (auto& [pair, each] : distances) {  // in order, so that neighbours are
    result.gaps[pair] = median(std::move(each));
    result.neighbours[static_cast<std::size_t>(pair.first)].push_back(pair.second);
    result.neighbours[static_cast<std::size_t>(pair.second)].push_back(pair.first);
  }
  for (auto& each : result.neighbours) std::ranges::sort(each);
  return result;
}

}  // namespace partwise
