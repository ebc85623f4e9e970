#include "partwise/motion/obstacle_boxes.h"

#include <limits>
#include <utility>

namespace partwise {

Eigen::Vector3d ObstacleBoxes::head(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  const auto known = std::min<Eigen::Index>(3, x.size());
  first.head(known) = x.head(known);
  return first;
}

ObstacleBoxes::ObstacleBoxes(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  std::vector<BoxTree::Box> heads;
  for (const Box& each : boxes_) heads.emplace_back(head(each.min()), head(each.max()));
  tree_ = BoxTree(std::move(heads));
}

std::array<int, 2> ObstacleBoxes::nearest_two(const MotionVector& x) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<int, 2> found = {-1, -1};
  std::array<double, 2> distances = {far, far};
  const Eigen::Vector3d first = head(x);
  tree_.near(first, far, [&](int number, double) {
    const Box& box = boxes_[static_cast<std::size_t>(number)];
    const double distance = BoxTree::Box(head(box.min()), head(box.max())).squaredExteriorDistance(first);
    if (distance < distances[0]) {
      found = {number, found[0]};
      distances = {distance, distances[0]};
    } else if (distance < distances[1]) {
      found[1] = number;
      distances[1] = distance;
    }
    return distances[1];
  });
  return found;
}

}  // namespace partwise
