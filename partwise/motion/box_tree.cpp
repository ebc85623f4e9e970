#include "partwise/motion/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace partwise {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

int BoxTree::build(int begin, int end) {
  constexpr int leaf = 4;
  const auto number = static_cast<int>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  Box centres;
  for (int i = begin; i < end; ++i) {
    const Box& box = boxes_[static_cast<std::size_t>(items_[static_cast<std::size_t>(i)])];
    node.box.extend(box);
    centres.extend(box.center());
  }
  nodes_.push_back(node);
  if (end - begin <= leaf) return number;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end, [&](int a, int b) {
    const auto key = [&](int i) { return std::pair(boxes_[static_cast<std::size_t>(i)].center()[axis], i); };
    return key(a) < key(b);
  });
  const int left = build(begin, middle), right = build(middle, end);
  nodes_[static_cast<std::size_t>(number)].left = left;
  nodes_[static_cast<std::size_t>(number)].right = right;
  return number;
}

}  // namespace partwise
