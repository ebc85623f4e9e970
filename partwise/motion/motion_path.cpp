#include "partwise/motion/motion_path.h"

#include <algorithm>
#include <limits>

#include "partwise/base/error.h"

namespace partwise {
namespace {

class Measure {
 public:
  explicit Measure(const Scene& scene) : scene_(scene), resolution_(1e-6 * scene.space().bounds().diagonal().norm()) {}

  double at(const Configuration& q) {
    const double distance = scene_.free(q) ? scene_.nearest(q, 1).front().distance : 0;
    minimum = std::min(minimum, distance);
    return distance;
  }

  // Between a and b, whose clearances are known.
  void along(const Configuration& a, double clearance_a, const Configuration& b, double clearance_b) {
    constexpr double longest = 0.1, precision = 0.01;
    const double length = scene_.space().displacement(a, b), both = clearance_a + clearance_b;
    const bool may_be_smaller = (both - length) / 2 < (1 - precision) * minimum;
    if (length > resolution_ && (length > longest * both / 2 || may_be_smaller)) {
      const Configuration middle = scene_.space().between(a, b, 0.5);
      const double clearance_middle = at(middle);
      along(a, clearance_a, middle, clearance_middle);
      along(middle, clearance_middle, b, clearance_b);
    } else {
      integral += length * both / 2;
    }
  }

  double minimum = std::numeric_limits<double>::infinity(), integral = 0;

 private:
  const Scene& scene_;
  double resolution_;
};

}  // namespace

double path_length(const ConfigurationSpace& space, const MotionPath& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.configurations.size(); ++i)
    length += space.displacement(path.configurations[i - 1], path.configurations[i]);
  return length;
}

Configuration path_at(const ConfigurationSpace& space, const MotionPath& path, double share) {
  PARTWISE_CHECK(path.configurations.size(), >, 0u);
  double left = share * path_length(space, path);
  for (std::size_t i = 1; i < path.configurations.size(); ++i) {
    const Configuration &a = path.configurations[i - 1], &b = path.configurations[i];
    const double length = space.displacement(a, b);
    if (left < length) return space.between(a, b, left / length);
    left -= length;
  }
  return path.configurations.back();
}

PathClearance path_clearance(const Scene& scene, const MotionPath& path) {
  PARTWISE_CHECK(path.configurations.size(), >, 0u);
  Measure measure(scene);
  std::vector<double> clearances;
  for (const Configuration& q : path.configurations) clearances.push_back(measure.at(q));
  for (std::size_t i = 1; i < clearances.size(); ++i)
    measure.along(path.configurations[i - 1], clearances[i - 1], path.configurations[i], clearances[i]);
  const double length = path_length(scene.space(), path);
  return {measure.minimum, length > 0 ? measure.integral / length : clearances.front()};
}

}  // namespace partwise
