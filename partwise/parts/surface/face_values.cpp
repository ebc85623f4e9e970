#include "partwise/parts/surface/face_values.h"

#include <Eigen/Geometry>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace partwise {
namespace {

constexpr double kRangeFactor = 1.5;  // deviation of the Gaussian in value, in root mean square differences

double gaussian(double x, double deviation) { return std::exp(-0.5 * (x / deviation) * (x / deviation)); }

// Faces within some steps of one face, in the order of a breadth-first search. Reused for many faces.
class Neighbourhood {
 public:
  explicit Neighbourhood(const FaceAdjacency& adjacency)
      : adjacency_(adjacency), seen_(adjacency.first.size() - 1, -1) {}

  struct Member {
    int face, steps;
  };
  const std::vector<Member>& of(int face, int window) {
    members_.assign(1, {face, 0});
    seen_[face] = face;
    for (std::size_t i = 0; i < members_.size() && members_[i].steps < window; ++i) {
      for (int next : adjacency_.of(members_[i].face)) {
        if (seen_[next] == face) continue;
        seen_[next] = face;
        members_.push_back({next, members_[i].steps + 1});
      }
    }
    return members_;
  }

 private:
  const FaceAdjacency& adjacency_;
  std::vector<int> seen_;
  std::vector<Member> members_;
};

double bilateral_mean(const std::vector<Neighbourhood::Member>& members, const Eigen::VectorXd& values, int window) {
  const double own = values[members.front().face];
  double squares = 0;
  for (const auto& member : members) squares += (values[member.face] - own) * (values[member.face] - own);
  const double deviation = kRangeFactor * std::sqrt(squares / static_cast<double>(members.size()));
  if (!(deviation > 0)) return own;  // no differences, or such that their squares vanish
  double sum = 0, weights = 0;
  for (const auto& member : members) {
    const double weight = gaussian(member.steps, window / 2.0) * gaussian(values[member.face] - own, deviation);
    sum += weight * values[member.face];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

Eigen::Index fill_missing(const FaceAdjacency& adjacency, Eigen::VectorXd& values) {
  std::vector<int> missing;
  for (Eigen::Index f = 0; f < values.size(); ++f)
    if (std::isnan(values[f])) missing.push_back(static_cast<int>(f));
  const auto count = static_cast<Eigen::Index>(missing.size());
  std::vector<int> later;
  std::vector<std::pair<int, double>> found;
  while (!missing.empty()) {
    later.clear(), found.clear();
    for (int f : missing) {
      double sum = 0;
      int known = 0;
      for (int other : adjacency.of(f)) {
        if (std::isnan(values[other])) continue;
        sum += values[other];
        ++known;
      }
      if (known > 0) {
        found.emplace_back(f, sum / known);
      } else {
        later.push_back(f);
      }
    }
    if (found.empty()) break;
    for (const auto& [f, value] : found) values[f] = value;
    missing.swap(later);
  }
  if (missing.empty()) return count;
  double least = std::numeric_limits<double>::infinity();
  for (double value : values)
    if (value < least) least = value;
  for (int f : missing) values[f] = std::isfinite(least) ? least : 0;
  return count;
}

Eigen::VectorXd smooth_bilaterally(const FaceAdjacency& adjacency, const Eigen::VectorXd& values, int window) {
  if (window <= 0) return values;
  Eigen::VectorXd result(values.size());
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, values.size(), 1024),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      Neighbourhood neighbourhood(adjacency);
                      for (Eigen::Index f = range.begin(); f < range.end(); ++f)
                        result[f] = bilateral_mean(neighbourhood.of(static_cast<int>(f), window), values, window);
                    });
  return result;
}

int default_window(Eigen::Index faces) {
  return 1 + static_cast<int>(std::floor(std::sqrt(static_cast<double>(faces) / 2000)));
}

Eigen::VectorXd normalised(const Eigen::VectorXd& values, double bend) {
  if (values.size() == 0) return values;
  const double low = values.minCoeff(), range = values.maxCoeff() - low;
  if (!(range > 0)) return Eigen::VectorXd::Zero(values.size());
  Eigen::VectorXd unit = (values.array() - low) / range;
  if (bend <= 0) return unit;
  return (1 + bend * unit.array()).log() / std::log1p(bend);
}

}  // namespace partwise
