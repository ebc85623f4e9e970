// Where the medial axis of the free space is: configurations whose two smallest obstacle distances are equal (Liu 2017,
// section 5.2; Wilmarth, Amato, Stiller 1999). Two obstacles count as two only where the robot can tell them apart:
// where they touch, all points straight before the seam are equally far from both and on no axis, as both distances
// grow in the same direction.
#pragma once

#include <array>
#include <vector>

#include "partwise/base/draw.h"
#include "partwise/motion/scene.h"

namespace partwise {

// Directions in which the distances to two obstacles grow are told apart from here on: 10 degrees.
inline constexpr double least_separation = 0.174311;  // 2 sin(5 degrees)

// On the axis: the two smallest distances differ by at most this share of the smaller.
inline constexpr double axis_share = 0.02;

struct AxisState {
  bool free = false;
  std::array<Near, 2> pair;  // the nearest obstacle, and the nearest other that can be told apart; -1 if there is none

  double clearance() const { return pair[0].distance; }
  double imbalance() const { return pair[1].distance - pair[0].distance; }
  bool on_axis(double share = axis_share) const { return free && imbalance() <= share * clearance(); }
};

// One query of distances and one of collision.
AxisState axis_state(const Scene& scene, const Configuration& q);

// What a method makes of a configuration: one on the medial axis, it says, or nothing.
struct Retraction {
  Configuration q;
  bool done = false;
  int steps = 0;
  int distance_queries = 0, collision_checks = 0;
};

class Retractor {
 public:
  virtual ~Retractor() = default;
  // `draw` is for methods that need random numbers.
  virtual Retraction operator()(const Configuration& q, Draw& draw) const = 0;
  // What sampling makes of a configuration: one, but for methods that find several at once. Never none.
  virtual std::vector<Retraction> samples(const Configuration& q, Draw& draw) const { return {(*this)(q, draw)}; }
};

}  // namespace partwise
