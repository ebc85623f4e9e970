// A robot among obstacles: where it is free, and how far it is from each obstacle. Everything that plans or samples
// asks these questions and no others, so that methods can be compared fairly.
//
// The distance from the robot at a configuration to an obstacle is the smallest between the robot's points and the
// obstacle's boundary in the world. Where robot and obstacle overlap it is 0 for robots with a body, and for a point
// how deep it lies; collision() tells. Free means that the robot touches no obstacle. Implementations are const and may
// be asked by many threads.
#pragma once

#include <Eigen/Geometry>

#include <limits>
#include <vector>

#include "partwise/motion/configuration_space.h"

namespace partwise {

struct Near {
  int obstacle = -1;  // -1: there is none
  double distance = std::numeric_limits<double>::infinity();
  Tangent gradient;  // how fast the distance grows along tangents; zero where the distance is 0
};

class Scene {
 public:
  explicit Scene(const ConfigurationSpace& space) : space_(space) {}
  virtual ~Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const ConfigurationSpace& space() const { return space_; }
  virtual int obstacles() const = 0;

  // An obstacle that the robot touches there, -1 when it is free.
  virtual int collision(const Configuration& q) const = 0;
  bool free(const Configuration& q) const { return collision(q) < 0; }

  // A displacement that keeps the robot within its bounds, 0 outside of them. Motions between two configurations within
  // convex bounds of the origin stay there, whatever their length: infinite.
  virtual double room(const Configuration& q) const {
    return space_.within_bounds(q) ? std::numeric_limits<double>::infinity() : 0;
  }
  bool within_bounds(const Configuration& q) const { return room(q) > 0; }

  virtual Near distance(const Configuration& q, int obstacle) const = 0;

  // The obstacles, nearest first, up to `count` of them; of equally near ones the lower number first.
  virtual std::vector<Near> nearest(const Configuration& q, int count) const = 0;

 private:
  ConfigurationSpace space_;
};

}  // namespace partwise
