#include "partwise/motion/sample_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <utility>

namespace partwise {
namespace {

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<MotionPoints, -1, nanoflann::metric_L2>;
constexpr double far = std::numeric_limits<double>::infinity();

// What nanoflann calls a result set: the nearest sample of each of the two nearest obstacles.
class TwoObstacles {
 public:
  explicit TwoObstacles(const std::vector<int>& obstacles) : obstacles_(obstacles) {}

  using DistanceType = double;
  std::size_t size() const { return (first >= 0) + (second >= 0); }
  bool full() const { return true; }
  double worstDist() const { return second_distance; }
  bool addPoint(double distance, std::size_t sample) {
    const int obstacle = obstacles_[sample];
    if (obstacle == first) {
      first_distance = std::min(first_distance, distance);
    } else if (distance < first_distance) {
      second = std::exchange(first, obstacle);
      second_distance = std::exchange(first_distance, distance);
    } else if (distance < second_distance) {
      second = obstacle;
      second_distance = distance;
    }
    return true;
  }

  int first = -1, second = -1;
  double first_distance = far, second_distance = far;  // squared

 private:
  const std::vector<int>& obstacles_;
};

class OtherObstacle {
 public:
  OtherObstacle(const std::vector<int>& obstacles, int but) : obstacles_(obstacles), but_(but) {}

  using DistanceType = double;
  std::size_t size() const { return 1; }
  bool full() const { return true; }
  double worstDist() const { return distance; }
  bool addPoint(double to, std::size_t sample) {
    if (obstacles_[sample] != but_ && to < distance) {
      nearest = static_cast<Eigen::Index>(sample);
      distance = to;
    }
    return true;
  }

  Eigen::Index nearest = -1;
  double distance = far;  // squared

 private:
  const std::vector<int>& obstacles_;
  int but_;
};

}  // namespace

struct SampleTree::Index {
  explicit Index(const MotionPoints& points) : tree(static_cast<int>(points.cols()), std::cref(points)) {}
  Tree tree;
};

SampleTree::SampleTree(const ContactSamples& samples)
    : samples_(samples), index_(std::make_unique<Index>(samples.points)) {}
SampleTree::~SampleTree() = default;

SampleTree::Pair SampleTree::nearest_two(const MotionVector& x) const {
  TwoObstacles found(samples_.obstacles);
  index_->tree.index->findNeighbors(found, x.data(), nanoflann::SearchParams());
  return {found.first, found.second, std::sqrt(found.first_distance), std::sqrt(found.second_distance)};
}

SampleTree::Sample SampleTree::nearest_other(const MotionVector& x, int obstacle) const {
  OtherObstacle found(samples_.obstacles, obstacle);
  index_->tree.index->findNeighbors(found, x.data(), nanoflann::SearchParams());
  return {found.nearest, std::sqrt(found.distance)};
}

}  // namespace partwise
