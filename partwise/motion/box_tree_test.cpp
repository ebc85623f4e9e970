#include "partwise/motion/box_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "partwise/base/draw.h"

namespace partwise {
namespace {

std::vector<BoxTree::Box> random_boxes(int count, Draw& draw) {
  std::vector<BoxTree::Box> boxes;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d low(draw.unit(), draw.unit(), draw.unit());
    boxes.emplace_back(low, low + 0.1 * Eigen::Vector3d(draw.unit(), draw.unit(), draw.unit()));
  }
  return boxes;
}

TEST(BoxTree, FindsWhatBruteForceFinds) {
  Draw draw(1, 0, 0);
  for (const int count : {0, 1, 4, 5, 37, 1000}) {
    const std::vector<BoxTree::Box> boxes = random_boxes(count, draw);
    const BoxTree tree(boxes);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p(draw.unit(), draw.unit(), draw.unit());
      std::set<int> around, truth;
      double nearest = std::numeric_limits<double>::infinity(), true_nearest = nearest;
      tree.around(p, [&](int item) { around.insert(item); });
      tree.near(p, nearest, [&](int item, double) {
        return nearest = std::min(nearest, boxes[static_cast<std::size_t>(item)].squaredExteriorDistance(p));
      });
      for (int k = 0; k < count; ++k) {
        const BoxTree::Box& box = boxes[static_cast<std::size_t>(k)];
        if (box.contains(p)) truth.insert(k);
        true_nearest = std::min(true_nearest, box.squaredExteriorDistance(p));
      }
      EXPECT_EQ(around, truth);
      EXPECT_EQ(nearest, true_nearest);
    }
  }
}

// Few boxes are looked at: the tree is a tree.
TEST(BoxTree, LooksAtFew) {
  Draw draw(2, 0, 0);
  const std::vector<BoxTree::Box> boxes = random_boxes(20000, draw);
  const BoxTree tree(boxes);
  int visits = 0;
  double bound = 1e-4;
  tree.near({0.5, 0.5, 0.5}, bound, [&](int, double same) {
    ++visits;
    return same;
  });
  int near = 0;
  for (const BoxTree::Box& box : boxes) near += box.squaredExteriorDistance(Eigen::Vector3d(0.5, 0.5, 0.5)) <= bound;
  EXPECT_EQ(visits, near);
}

}  // namespace
}  // namespace partwise
