// How far a convex body reaches outside a solid: the `hull` measure of concavity, certified rather than sampled.
//
// The distance to the solid (0 inside it) changes by at most the length of a step, so its value s at the centre of a
// cube bounds it over the whole cube by s + r, r half the cube's diagonal. An octree over space keeps these values,
// made when first asked for; a body is within tolerance when every cube that it meets is bounded by it. Cubes that
// straddle the bound are split down to the resolution and then counted against the body: what is certified holds, what
// is refused may have been fine by twice the diagonal of the smallest cube. An open surface has no inside: the distance
// is to the surface. Not thread-safe: queries fill the octree.
#pragma once

#include <cstdint>
#include <vector>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/surface_query.h"

namespace partwise {

// A convex body as the octree meets it: its planes and its box.
struct ConvexBody {
  explicit ConvexBody(const Mesh& hull);

  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> planes;  // n . x <= d inside
  Point low, high;
};

class OutsideDistance {
 public:
  // `box` bounds the solid. Of bodies that reach farther from its centre than four times its radius less is known: only
  // that no point of them is farther outside than a corner of their box can be. `resolution`: side of the smallest
  // cubes, model units.
  OutsideDistance(const SurfaceQuery& surface, bool closed, const Sphere& box, double resolution);

  // Whether no point of the body is farther outside than the tolerance.
  bool within(const ConvexBody& body, double tolerance);

  // An upper bound of the largest distance outside that is reached, too large by at most `accuracy` or the diagonal of
  // a smallest cube, whichever is more, and a point of the body (to the same accuracy) where it is nearly reached.
  struct Reach {
    double distance = 0;
    Point where = Point::Zero();
  };
  Reach reach(const ConvexBody& body, double accuracy = 0);

 private:
  struct Cube {
    float signed_distance;  // of the centre, negative inside
    std::int32_t first_child = -1;
  };
  struct Visit;

  double signed_distance(const Point& centre, double parent_value, double step) const;
  double beyond(const ConvexBody& body) const;  // that bound; 0 for bodies that lie in the root cube
  void split(std::int32_t cube, const Point& centre, double half);

  const SurfaceQuery& surface_;
  bool closed_;
  Point centre_;
  double half_;
  int depth_;
  std::vector<Cube> cubes_;
  std::vector<int> active_;  // stack of the planes that still cut the cubes being visited
};

}  // namespace partwise
