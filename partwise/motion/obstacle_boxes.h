// Boxes of a Euclidean space of up to twelve dimensions, a number each, asked which of them hold a point: a tree over
// their first coordinates, three at most; the others are looked at one by one.
#pragma once

#include <array>
#include <vector>

#include "partwise/motion/box_tree.h"
#include "partwise/motion/configuration_space.h"

namespace partwise {

class ObstacleBoxes {
 public:
  using Box = Eigen::AlignedBox<double, Eigen::Dynamic>;

  explicit ObstacleBoxes(std::vector<Box> boxes);

  template <typename Visit>
  void for_each_around(const MotionVector& x, Visit&& visit) const {
    tree_.around(head(x), [&](int number) {
      const Box& box = boxes_[static_cast<std::size_t>(number)];
      if (box.contains(x)) visit(number);
    });
  }
  // The two nearest boxes by their first coordinates; -1 where there are fewer.
  std::array<int, 2> nearest_two(const MotionVector& x) const;

 private:
  static Eigen::Vector3d head(const Eigen::Ref<const Eigen::VectorXd>& x);

  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace partwise
