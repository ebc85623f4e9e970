// A binary tree of axis-aligned boxes in space, halved at the median of their centres along the longest axis. Asked for
// boxes near a point or a box, it goes down the nearer side first; time about log n and what lies as near as the
// answer.
//
// Boxes are those of items 0 .. n - 1. What is visited, and in which order, depends on them and what is asked alone.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace partwise {

class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  Box bounds() const { return nodes_.empty() ? Box() : nodes_.front().box; }

  // Calls visit(item, bound2) for items whose boxes are no farther than the square root of bound2, which visit returns
  // anew each time: how far, squared, is still of interest.
  template <typename Visit>
  void near(const Eigen::Vector3d& p, double bound2, Visit&& visit) const {
    if (!nodes_.empty()) near(0, p, bound2, visit);
  }
  template <typename Visit>
  void near(const Box& box, double bound2, Visit&& visit) const {
    if (!nodes_.empty()) near(0, box, bound2, visit);
  }

  // Calls visit(item) for the boxes that hold p.
  template <typename Visit>
  void around(const Eigen::Vector3d& p, Visit&& visit) const {
    near(p, 0, [&](int item, double bound2) {
      visit(item);
      return bound2;
    });
  }

 private:
  struct Node {
    Box box;
    int begin = 0, end = 0;  // of items_; a leaf has no children
    int left = -1, right = -1;
  };

  int build(int begin, int end);

  template <typename Where, typename Visit>
  void near(int number, const Where& p, double& bound2, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const int item = items_[static_cast<std::size_t>(i)];
        if (boxes_[static_cast<std::size_t>(item)].squaredExteriorDistance(p) <= bound2) bound2 = visit(item, bound2);
      }
      return;
    }
    const auto distance = [&](int child) {
      return nodes_[static_cast<std::size_t>(child)].box.squaredExteriorDistance(p);
    };
    const double left = distance(node.left), right = distance(node.right);
    const bool left_first = left <= right;
    if (std::min(left, right) <= bound2) near(left_first ? node.left : node.right, p, bound2, visit);
    if (std::max(left, right) <= bound2) near(left_first ? node.right : node.left, p, bound2, visit);
  }

  std::vector<Box> boxes_;
  std::vector<int> items_;
  std::vector<Node> nodes_;
};

}  // namespace partwise
