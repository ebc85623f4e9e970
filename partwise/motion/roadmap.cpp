#include "partwise/motion/roadmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <nanoflann.hpp>
#include <utility>

#include "partwise/geometry/disjoint_sets.h"
#include "partwise/motion/contact_samples.h"
#include "partwise/motion/free_motion.h"
#include "partwise/motion/sample_tree.h"

namespace partwise {
namespace {

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<MotionPoints, -1, nanoflann::metric_L2>;
constexpr std::uint64_t edge_purpose = 2;

using Pairs = std::vector<std::pair<int, int>>;

MotionPoints embedded(const ConfigurationSpace& space, const std::vector<AxisSample>& samples) {
  MotionPoints points(static_cast<Eigen::Index>(samples.size()), space.embedding());
  for (std::size_t i = 0; i < samples.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = space.embedded(samples[i].q).transpose();
  return points;
}

// Pairs of samples of which one is among the nearest of the other.
Pairs near_pairs(const MotionPoints& points, int neighbours) {
  const Tree tree(static_cast<int>(points.cols()), std::cref(points));
  const auto samples = static_cast<std::size_t>(points.rows());
  const std::size_t wanted = std::min(samples, static_cast<std::size_t>(neighbours) + 1);
  Pairs pairs(samples * wanted);
  tbb::parallel_for(std::size_t(0), samples, [&](std::size_t i) {
    std::vector<Eigen::Index> found(wanted);
    std::vector<double> distances(wanted);
    const MotionVector x = points.row(static_cast<Eigen::Index>(i)).transpose();
    tree.query(x.data(), wanted, found.data(), distances.data());
    for (std::size_t k = 0; k < wanted; ++k)
      pairs[i * wanted + k] = std::minmax(static_cast<int>(i), static_cast<int>(found[k]));
  });
  std::erase_if(pairs, [](const auto& pair) { return pair.first == pair.second; });
  std::ranges::sort(pairs);
  const auto repeated = std::ranges::unique(pairs);
  pairs.erase(repeated.begin(), repeated.end());
  return pairs;
}

class Connector {
 public:
  Connector(const Scene& scene, const Retractor& retract, const RoadmapSettings& settings)
      : scene_(scene),
        retract_(retract),
        push_(settings.push),
        resolution_(settings.resolution * scene.space().bounds().diagonal().norm()) {}

  struct Stop {
    Configuration q;
    double clearance = 0;
  };
  struct Way {
    std::vector<Configuration> between;
    long distance_queries = 0;
  };

  // Adds the bends between a and b; false where there is no way.
  bool join(const Stop& a, const Stop& b, int depth, Draw& draw, Way& way) const {
    const double length = scene_.space().displacement(a.q, b.q);
    if (length < std::min(a.clearance, b.clearance)) return true;
    if (push_ && depth > 0) {
      const Stop middle = pushed_middle(a, b, draw, way);
      const double detour = scene_.space().displacement(a.q, middle.q) + scene_.space().displacement(middle.q, b.q);
      if (middle.clearance > 0 && detour < most_detour * length) {
        const std::size_t before = way.between.size();
        if (join(a, middle, depth - 1, draw, way)) {
          way.between.push_back(middle.q);
          if (join(middle, b, depth - 1, draw, way)) return true;
        }
        way.between.resize(before);
      }
    }
    const MotionCheck check = free_motion(scene_, a.q, a.clearance, b.q, b.clearance, resolution_);
    way.distance_queries += check.distance_queries;
    return check.free;
  }

 private:
  static constexpr double most_detour = 1.5;

  Stop pushed_middle(const Stop& a, const Stop& b, Draw& draw, Way& way) const {
    const Retraction walk = retract_(scene_.space().between(a.q, b.q, 0.5), draw);
    way.distance_queries += walk.distance_queries + 1;
    return {walk.q, walk.done ? clearance(scene_, walk.q) : 0};
  }

  const Scene& scene_;
  const Retractor& retract_;
  bool push_;
  double resolution_;
};

// Of each sample the component that edges join it to, from 0 on.
std::vector<int> components(const std::vector<RoadmapEdge>& edges, std::size_t samples, int& count) {
  DisjointSets sets(samples);
  for (const RoadmapEdge& each : edges) sets.join(each.from, each.to);
  std::vector<int> number(samples, -1);
  count = 0;
  for (std::size_t i = 0; i < samples; ++i) {  // the root of a set is its first sample
    const auto root = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
    number[i] = root == i ? count++ : number[root];
  }
  return number;
}

// Of each component but the largest, and each other one that is nearest to any of its samples: the nearest samples.
Pairs pairs_across(const MotionPoints& points, std::vector<int> component, int count) {
  std::vector<int> sizes(static_cast<std::size_t>(count));
  for (const int each : component) ++sizes[static_cast<std::size_t>(each)];
  const auto largest = static_cast<int>(std::ranges::max_element(sizes) - sizes.begin());
  const ContactSamples labelled{points, std::move(component), count};
  const SampleTree tree(labelled);
  std::vector<SampleTree::Sample> others(labelled.obstacles.size());
  tbb::parallel_for(std::size_t(0), others.size(), [&](std::size_t i) {
    if (labelled.obstacles[i] == largest) return;
    others[i] = tree.nearest_other(points.row(static_cast<Eigen::Index>(i)).transpose(), labelled.obstacles[i]);
  });
  using Ends = std::pair<int, int>;
  std::map<Ends, std::pair<double, Ends>> nearest;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (others[i].sample < 0) continue;
    const auto other = static_cast<int>(others[i].sample);
    const Ends key = std::minmax(labelled.obstacles[i], labelled.obstacles[static_cast<std::size_t>(other)]);
    const std::pair<double, Ends> candidate(others[i].distance, std::minmax(static_cast<int>(i), other));
    const auto [at, is_new] = nearest.emplace(key, candidate);
    if (!is_new) at->second = std::min(at->second, candidate);
  }
  Pairs pairs;
  for (const auto& [key, each] : nearest) pairs.push_back(each.second);
  return pairs;
}

}  // namespace

Roadmap connected(const Scene& scene, const std::vector<AxisSample>& samples, const Retractor& retract,
                  const RoadmapSettings& settings, const Progress& progress) {
  Roadmap roadmap;
  if (samples.empty()) return roadmap;
  const MotionPoints points = embedded(scene.space(), samples);
  const Connector connector(scene, retract, settings);
  const auto stop = [&](int i) {
    const AxisSample& sample = samples[static_cast<std::size_t>(i)];
    return Connector::Stop{sample.q, std::min(sample.state.clearance(), scene.room(sample.q))};
  };
  std::uint64_t tried = 0;
  // Whether any of the pairs could be joined.
  const auto join = [&](const Pairs& pairs) {
    std::vector<std::pair<bool, Connector::Way>> ways(pairs.size());
    SharedProgress shared(progress, "connect", static_cast<int>(pairs.size()));
    tbb::parallel_for(std::size_t(0), pairs.size(), [&](std::size_t i) {
      Draw draw(settings.seed, tried + i, edge_purpose);
      auto& [joined, way] = ways[i];
      joined = connector.join(stop(pairs[i].first), stop(pairs[i].second), settings.depth, draw, way);
      shared.add(1);
    });
    tried += pairs.size();
    const std::size_t before = roadmap.edges.size();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      auto& [joined, way] = ways[i];
      roadmap.distance_queries += way.distance_queries;
      if (joined) roadmap.edges.push_back({pairs[i].first, pairs[i].second, std::move(way.between)});
    }
    return roadmap.edges.size() > before;
  };
  bool more = join(near_pairs(points, settings.neighbours));
  std::vector<int> component = components(roadmap.edges, samples.size(), roadmap.components);
  while (more && roadmap.components > 1) {
    more = join(pairs_across(points, std::move(component), roadmap.components));
    component = components(roadmap.edges, samples.size(), roadmap.components);
  }
  std::ranges::sort(roadmap.edges, {}, [](const RoadmapEdge& each) { return std::pair(each.from, each.to); });
  return roadmap;
}

}  // namespace partwise
