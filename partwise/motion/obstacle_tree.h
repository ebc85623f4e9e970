// Nearest points of obstacles that are made of segments or triangles: a tree of the obstacles' boxes over one
// of each obstacle's simplices. What the plane holds has z = 0.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/motion/box_tree.h"

namespace partwise {

// A segment repeats its second end.
using Simplex = std::array<Point, 3>;

struct NearestPoint {
  int obstacle = -1;
  double distance = std::numeric_limits<double>::infinity();
  Point offset = Point::Zero();  // from the nearest point to the one that was asked about
};

class ObstacleTree {
 public:
  // Errors: CheckFailed for an obstacle without simplices.
  explicit ObstacleTree(const std::vector<std::vector<Simplex>>& obstacles);

  int obstacles() const { return static_cast<int>(obstacles_.size()); }
  NearestPoint nearest(const Point& p, int obstacle) const;
  // The obstacles whose bounding boxes hold p, by number.
  std::vector<int> boxes_around(const Point& p) const;
  // Up to `count` obstacles, nearest first; of equally near ones the lower number first.
  std::vector<NearestPoint> nearest_obstacles(const Point& p, int count) const;

 private:
  struct Obstacle {
    std::vector<Simplex> simplices;
    BoxTree tree;
  };
  NearestPoint nearest(const Point& p, int obstacle, double bound2) const;

  std::vector<Obstacle> obstacles_;
  BoxTree boxes_;
};

}  // namespace partwise
