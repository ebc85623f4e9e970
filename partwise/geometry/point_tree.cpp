#include "partwise/geometry/point_tree.h"

#include <algorithm>
#include <numeric>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

constexpr int kLeafPoints = 8;

}  // namespace

PointTree::PointTree(Vertices points) : points_(std::move(points)), order_(static_cast<std::size_t>(points_.rows())) {
  std::iota(order_.begin(), order_.end(), 0);
  std::size_t leaves = 1;
  while (leaves * kLeafPoints < order_.size()) leaves *= 2;
  boxes_.resize(2 * leaves - 1);
  if (!order_.empty()) build(0, 0, static_cast<int>(order_.size()));
}

void PointTree::build(std::size_t node, int begin, int end) {
  Point low = points_.row(order_[begin]), high = low;
  for (int i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(points_.row(order_[i]));
    high = high.cwiseMax(points_.row(order_[i]));
  }
  boxes_[node] = {(low + high) / 2, (high - low) / 2};
  if (2 * node + 1 >= boxes_.size()) return;
  Eigen::Index axis;
  (high - low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    return points_(a, axis) != points_(b, axis) ? points_(a, axis) < points_(b, axis) : a < b;
  });
  if (middle > begin) build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

struct PointTree::Query {
  const PointTree& tree;
  const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>& planes;
  std::vector<int> active;  // a stack: of each box on the way down, the planes that cut it
  std::vector<int> found;

  // The planes that cut the box above are active[first, last).
  void visit(std::size_t node, int begin, int end, std::size_t first, std::size_t last) {
    const Box& box = tree.boxes_[node];
    const std::size_t cutting = active.size();
    for (std::size_t i = first; i < last; ++i) {
      const double* plane = planes.row(active[i]).data();
      const double height = plane[0] * box.centre[0] + plane[1] * box.centre[1] + plane[2] * box.centre[2] - plane[3];
      const double reach =
          std::abs(plane[0]) * box.half[0] + std::abs(plane[1]) * box.half[1] + std::abs(plane[2]) * box.half[2];
      if (height > reach) {
        active.resize(cutting);
        return;
      }
      if (height > -reach) active.push_back(active[i]);
    }
    const std::size_t cut = active.size();
    if (cut == cutting) {
      found.insert(found.end(), tree.order_.begin() + begin, tree.order_.begin() + end);
    } else if (2 * node + 1 >= tree.boxes_.size()) {
      for (int i = begin; i < end; ++i) {
        if (holds(tree.order_[i], cutting, cut)) found.push_back(tree.order_[i]);
      }
    } else {
      const int middle = begin + (end - begin) / 2;
      if (middle > begin) visit(2 * node + 1, begin, middle, cutting, cut);
      visit(2 * node + 2, middle, end, cutting, cut);
    }
    active.resize(cutting);
  }

  bool holds(int point, std::size_t first, std::size_t last) const {
    const double* p = tree.points_.row(point).data();
    for (std::size_t i = first; i < last; ++i) {
      const double* plane = planes.row(active[i]).data();
      if (plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] > plane[3]) return false;
    }
    return true;
  }
};

std::vector<int> PointTree::inside(const Mesh& hull) const {
  if (order_.empty()) return {};
  const auto planes = hull_planes(hull);
  Query query{*this, planes, std::vector<int>(static_cast<std::size_t>(planes.rows())), {}};
  std::iota(query.active.begin(), query.active.end(), 0);
  query.visit(0, 0, static_cast<int>(order_.size()), 0, query.active.size());
  return std::move(query.found);
}

}  // namespace partwise
