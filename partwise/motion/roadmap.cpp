#include "partwise/motion/roadmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <nanoflann.hpp>
#include <numeric>
#include <set>
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

// The nearest samples of each of `wanted`, itself among them: a column each, nearest first.
using Neighbours = Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic>;
Neighbours near_neighbours(const MotionPoints& points, const std::vector<int>& wanted, int neighbours) {
  const Tree tree(static_cast<int>(points.cols()), std::cref(points));
  const auto each = std::min(points.rows(), static_cast<Eigen::Index>(neighbours) + 1);
  Neighbours found(each, static_cast<Eigen::Index>(wanted.size()));
  tbb::parallel_for(Eigen::Index(0), found.cols(), [&](Eigen::Index i) {
    std::vector<double> distances(static_cast<std::size_t>(each));
    const MotionVector x = points.row(wanted[static_cast<std::size_t>(i)]).transpose();
    tree.query(x.data(), static_cast<std::size_t>(each), found.col(i).data(), distances.data());
  });
  return found;
}

// Pairs of `wanted` and of what stands in these rows of their columns, each once.
Pairs pairs_of(const std::vector<int>& wanted, const Neighbours& found, Eigen::Index first, Eigen::Index count) {
  Pairs pairs;
  for (Eigen::Index i = 0; i < found.cols(); ++i) {
    const int from = wanted[static_cast<std::size_t>(i)];
    for (Eigen::Index k = first; k < first + count; ++k)
      pairs.push_back(std::minmax(from, static_cast<int>(found(k, i))));
  }
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
    double clearance = std::numeric_limits<double>::infinity();  // the smallest that was asked for on it
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
        const std::size_t bends = way.between.size();
        const double least = way.clearance;
        way.clearance = std::min(least, middle.clearance);
        if (join(a, middle, depth - 1, draw, way)) {
          way.between.push_back(middle.q);
          if (join(middle, b, depth - 1, draw, way)) return true;
        }
        way.between.resize(bends);
        way.clearance = least;
      }
    }
    const MotionCheck check = free_motion(scene_, a.q, a.clearance, b.q, b.clearance, resolution_);
    way.distance_queries += check.distance_queries;
    way.clearance = std::min(way.clearance, check.least);
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

// Of each component but the largest, and each other one that is nearest to any of its samples: the nearest samples,
// less those pairs that are `known`.
Pairs pairs_across(const MotionPoints& points, std::vector<int> component, int count,
                   const std::set<std::pair<int, int>>& known) {
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
    if (known.contains(candidate.second)) continue;
    const auto [at, is_new] = nearest.emplace(key, candidate);
    if (!is_new) at->second = std::min(at->second, candidate);
  }
  Pairs pairs;
  for (const auto& [key, each] : nearest) pairs.push_back(each.second);
  return pairs;
}

}  // namespace

struct GrowingRoadmap::State {
  State(const Scene& the_scene, const Retractor& retract, const RoadmapSettings& the_settings)
      : scene(the_scene), settings(the_settings), connector(the_scene, retract, the_settings) {}

  const Scene& scene;
  RoadmapSettings settings;
  Connector connector;
  std::vector<AxisSample> samples;
  MotionPoints points;  // embedded
  std::vector<int> endpoints;
  std::size_t connected = 0;  // samples that were joined to their nearest neighbours
  std::uint64_t tried = 0;
  std::set<std::pair<int, int>> known;  // pairs that were tried and may come up again
  Pairs left_out;                       // for want of cycles
  Roadmap roadmap;

  Connector::Stop stop(int i) const {
    const AxisSample& sample = samples[static_cast<std::size_t>(i)];
    return {sample.q, std::min(sample.state.clearance(), scene.room(sample.q))};
  }

  void take(const std::vector<AxisSample>& more) {
    samples.insert(samples.end(), more.begin(), more.end());
    const auto before = points.rows();
    points.conservativeResize(static_cast<Eigen::Index>(samples.size()), scene.space().embedding());
    for (Eigen::Index i = before; i < points.rows(); ++i)
      points.row(i) = scene.space().embedded(samples[static_cast<std::size_t>(i)].q).transpose();
  }

  RoadmapEdge edge(const std::pair<int, int>& pair, Connector::Way& way) const {
    RoadmapEdge result{pair.first, pair.second, std::move(way.between)};
    const Connector::Stop from = stop(pair.first), to = stop(pair.second);
    result.clearance = std::min({way.clearance, from.clearance, to.clearance});
    const Configuration* last = &from.q;
    for (const Configuration& q : result.between) {
      result.length += scene.space().displacement(*last, q);
      last = &q;
    }
    result.length += scene.space().displacement(*last, to.q);
    return result;
  }

  // Whether any of the pairs could be joined.
  bool join(const Pairs& pairs, const Progress& progress) {
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
      if (joined) roadmap.edges.push_back(edge(pairs[i], way));
    }
    return roadmap.edges.size() > before;
  }

  // New samples, and endpoints that are no longer new.
  std::vector<int> unjoined() const {
    std::vector<int> result(samples.size() - connected);
    std::iota(result.begin(), result.end(), static_cast<int>(connected));
    for (const int each : endpoints) {
      if (static_cast<std::size_t>(each) < connected) result.push_back(each);
    }
    return result;
  }
  bool of_endpoint(const std::pair<int, int>& pair) const {
    return std::ranges::any_of(endpoints, [&](int each) { return each == pair.first || each == pair.second; });
  }

  // To their nearest neighbours: to all at once or, without cycles, to the nearest first and then to those that this
  // has not joined yet.
  void join_near(const std::vector<int>& wanted, const Progress& progress) {
    const Neighbours found = near_neighbours(points, wanted, settings.neighbours);
    const Eigen::Index rows = settings.cycles ? found.rows() : 1;
    std::set<std::pair<int, int>> tried_now;
    for (Eigen::Index first = 0; first < found.rows(); first += rows) {
      Pairs pairs = pairs_of(wanted, found, first, rows);
      std::erase_if(pairs, [&](const auto& pair) { return known.contains(pair) || tried_now.contains(pair); });
      tried_now.insert(pairs.begin(), pairs.end());
      if (!settings.cycles) leave_out_joined(pairs);
      join_known(pairs, progress);
    }
  }

  void leave_out_joined(Pairs& pairs) {
    const std::vector<int> component = components(roadmap.edges, samples.size(), roadmap.components);
    const auto joined = std::ranges::stable_partition(pairs, [&](const auto& pair) {
      return component[static_cast<std::size_t>(pair.first)] != component[static_cast<std::size_t>(pair.second)];
    });
    left_out.insert(left_out.end(), joined.begin(), joined.end());
    pairs.erase(joined.begin(), joined.end());
  }

  // Endpoints look for neighbours again later.
  void join_known(const Pairs& pairs, const Progress& progress) {
    join(pairs, progress);
    std::ranges::copy_if(pairs, std::inserter(known, known.end()), [&](const auto& pair) { return of_endpoint(pair); });
  }

  void connect(const Progress& progress) {
    join_near(unjoined(), progress);
    connected = samples.size();
    for (bool more = true; more;) {
      std::vector<int> component = components(roadmap.edges, samples.size(), roadmap.components);
      if (roadmap.components == 1) break;
      const Pairs across = pairs_across(points, std::move(component), roadmap.components, known);
      more = join(across, progress);
      known.insert(across.begin(), across.end());
    }
    sort_edges();
  }

  bool add_cycles(const MotionPath& path, const Progress& progress) {
    std::vector<bool> passed(samples.size(), false);
    for (std::size_t i = 0; i < samples.size(); ++i)
      passed[i] = std::ranges::find(path.configurations, samples[i].q) != path.configurations.end();
    std::vector<bool> about = passed;
    const auto reach = [&](int a, int b) {
      if (passed[static_cast<std::size_t>(a)]) about[static_cast<std::size_t>(b)] = true;
      if (passed[static_cast<std::size_t>(b)]) about[static_cast<std::size_t>(a)] = true;
    };
    for (const RoadmapEdge& each : roadmap.edges) reach(each.from, each.to);
    for (const auto& [a, b] : left_out) reach(a, b);
    const auto near = std::ranges::partition(left_out, [&](const auto& pair) {
      return !about[static_cast<std::size_t>(pair.first)] || !about[static_cast<std::size_t>(pair.second)];
    });
    std::set<std::pair<int, int>> pairs(near.begin(), near.end());  // once, those of endpoints too
    // A stop may have come between an edge and the note that it is there.
    for (const RoadmapEdge& each : roadmap.edges) pairs.erase({each.from, each.to});
    join_known({pairs.begin(), pairs.end()}, progress);
    left_out.erase(near.begin(), near.end());
    sort_edges();
    return !pairs.empty();
  }

  void sort_edges() {
    std::ranges::sort(roadmap.edges, {}, [](const RoadmapEdge& each) { return std::pair(each.from, each.to); });
  }
};

GrowingRoadmap::GrowingRoadmap(const Scene& scene, const Retractor& retract, const RoadmapSettings& settings)
    : state_(std::make_unique<State>(scene, retract, settings)) {}
GrowingRoadmap::~GrowingRoadmap() = default;

const std::vector<AxisSample>& GrowingRoadmap::samples() const { return state_->samples; }
const Roadmap& GrowingRoadmap::roadmap() const { return state_->roadmap; }

int GrowingRoadmap::add_endpoint(const Configuration& q) {
  state_->take({{q, axis_state(state_->scene, q)}});
  state_->endpoints.push_back(static_cast<int>(state_->samples.size()) - 1);
  return state_->endpoints.back();
}

void GrowingRoadmap::add(const std::vector<AxisSample>& samples, const Progress& progress) {
  state_->take(samples);
  if (!state_->samples.empty()) state_->connect(progress);
}

bool GrowingRoadmap::add_cycles(const MotionPath& path, const Progress& progress) {
  return state_->add_cycles(path, progress);
}

Roadmap connected(const Scene& scene, const std::vector<AxisSample>& samples, const Retractor& retract,
                  const RoadmapSettings& settings, const Progress& progress) {
  GrowingRoadmap growing(scene, retract, settings);
  growing.add(samples, progress);
  return growing.roadmap();
}

}  // namespace partwise
