#include "partwise/motion/margin_field.h"

#include <tbb/concurrent_unordered_map.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/motion/neighbourhood.h"
#include "partwise/motion/obstacle_boxes.h"

namespace partwise {
namespace {

// Of each point to the nearest one of others.
Eigen::VectorXd distances(const MotionPoints& points, const MotionPoints& others) {
  Eigen::VectorXd result(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    result[i] = (others.rowwise() - points.row(i)).rowwise().norm().minCoeff();
  return result;
}

// At most `count` of the points, those nearest to others, in their order.
MotionPoints nearest(const MotionPoints& points, const MotionPoints& others, int count) {
  if (points.rows() <= count) return points;
  const Eigen::VectorXd distance = distances(points, others);
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(points.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::ranges::nth_element(rows, rows.begin() + count, [&](Eigen::Index a, Eigen::Index b) {
    return std::pair(distance[a], a) < std::pair(distance[b], b);
  });
  rows.resize(static_cast<std::size_t>(count));
  std::ranges::sort(rows);
  return points(rows, Eigen::all);
}

}  // namespace

struct MarginField::Parts {
  struct Late {
    std::once_flag once;
    std::optional<MarginClassifier> classifier;
  };

  MarginFieldSettings settings;
  ContactSamples samples;
  std::vector<std::vector<Eigen::Index>> rows;  // of each obstacle
  Neighbourhood near;
  std::vector<MarginClassifier> against_others;
  std::optional<ObstacleBoxes> reach;
  tbb::concurrent_unordered_map<std::uint64_t, std::shared_ptr<Late>> pairs;

  std::vector<Eigen::Index> rows_of(const std::vector<int>& obstacles) const {
    std::vector<Eigen::Index> all;
    for (const int each : obstacles) {
      const auto& own = rows[static_cast<std::size_t>(each)];
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }
  MotionPoints points_of(const std::vector<int>& obstacles) const {
    return samples.points(rows_of(obstacles), Eigen::all);
  }

  // The samples of one obstacle, then those of the others, of which only the nearest ones matter.
  MarginClassifier trained(int positive, const std::vector<int>& negative, double width) const {
    constexpr double narrowest = 1e-3;  // share of the extent: touching obstacles have no gap, kernels need a width
    const MotionPoints own = points_of({positive}), others = nearest(points_of(negative), own, settings.most_others);
    MotionPoints points(own.rows() + others.rows(), own.cols());
    points << own, others;
    const double extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
    return {points, own.rows(), {.width = std::max(width, narrowest * extent), .cost = settings.cost}};
  }

  // Of those that never were neighbours, the smallest.
  double gap(const ObstaclePair& pair) const {
    const auto known = near.gaps.find(pair);
    if (known != near.gaps.end()) return known->second;
    const MotionPoints a = points_of({pair.first}), b = points_of({pair.second});
    return distances(a, b).minCoeff();
  }

  const MarginClassifier& between(const ObstaclePair& pair) {
    const std::uint64_t key = static_cast<std::uint64_t>(pair.first) << 32 | static_cast<std::uint32_t>(pair.second);
    auto found = pairs.find(key);
    if (found == pairs.end()) found = pairs.emplace(key, std::make_shared<Late>()).first;
    Late& late = *found->second;
    std::call_once(late.once, [&] {
      late.classifier.emplace(trained(pair.first, {pair.second}, settings.gap_width * gap(pair)));
    });
    return *late.classifier;
  }

  ObstacleBoxes::Box reach_of(int obstacle) const {
    const MotionPoints points = points_of({obstacle});
    ObstacleBoxes::Box box(points.colwise().minCoeff().transpose(), points.colwise().maxCoeff().transpose());
    box.min().array() -= near.reaches[static_cast<std::size_t>(obstacle)];
    box.max().array() += near.reaches[static_cast<std::size_t>(obstacle)];
    return box;
  }
};

MarginField::MarginField(const ConfigurationSpace& space, const ContactSamples& samples,
                         const MarginFieldSettings& settings, const Progress& progress)
    : parts_(std::make_unique<Parts>()) {
  if (samples.count < 2)
    throw InputError("scene", "has fewer than two obstacles", "a medial axis lies between obstacles: give two or more");
  Parts& parts = *parts_;
  parts.settings = settings;
  parts.samples = settings.density > 0 ? thinned(samples, settings.density) : samples;
  parts.rows.resize(static_cast<std::size_t>(samples.count));
  for (Eigen::Index i = 0; i < parts.samples.size(); ++i)
    parts.rows[static_cast<std::size_t>(parts.samples.obstacles[static_cast<std::size_t>(i)])].push_back(i);
  parts.near = neighbourhood(space, parts.samples, settings.seed);

  std::vector<std::optional<MarginClassifier>> trained(static_cast<std::size_t>(samples.count));
  SharedProgress shared(progress, "train", samples.count);
  tbb::parallel_for(0, samples.count, [&](int i) {
    const auto number = static_cast<std::size_t>(i);
    const std::vector<int>& neighbours = parts.near.neighbours[number];
    trained[number].emplace(parts.trained(i, neighbours, settings.reach_width * parts.near.reaches[number]));
    for (const int other : neighbours) {
      if (i < other) parts.between({i, other});
    }
    shared.add(1);
  });
  std::vector<ObstacleBoxes::Box> reaches;
  for (auto& each : trained) {
    reaches.push_back(parts.reach_of(static_cast<int>(reaches.size())));
    parts.against_others.push_back(std::move(*each));
  }
  parts.reach.emplace(std::move(reaches));
}

MarginField::~MarginField() = default;

int MarginField::obstacles() const { return parts_->samples.count; }
const ContactSamples& MarginField::samples() const { return parts_->samples; }

std::array<int, 2> MarginField::nearest_two(const MotionVector& x) const {
  std::array<int, 2> best = {-1, -1};
  std::array<double, 2> scores = {};
  parts_->reach->for_each_around(x, [&](int obstacle) {
    const double score = parts_->against_others[static_cast<std::size_t>(obstacle)].value(x);
    if (best[0] < 0 || score > scores[0]) {
      best = {obstacle, best[0]};
      scores = {score, scores[0]};
    } else if (best[1] < 0 || score > scores[1]) {
      best[1] = obstacle;
      scores[1] = score;
    }
  });
  return best[1] < 0 ? parts_->reach->nearest_two(x) : best;
}

const MarginClassifier& MarginField::against_others(int obstacle) const {
  return parts_->against_others[static_cast<std::size_t>(obstacle)];
}

const MarginClassifier& MarginField::between(int a, int b) const { return parts_->between(ordered(a, b)); }

MarginField::Size MarginField::size() const {
  Size size;
  for (const auto& [key, late] : parts_->pairs) {
    ++size.pairs;
    size.supports += late->classifier->supports();
  }
  for (const MarginClassifier& each : parts_->against_others) size.supports_against_others += each.supports();
  return size;
}

}  // namespace partwise
