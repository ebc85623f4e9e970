#include "partwise/parts/solid/outside_distance.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace partwise {
namespace {

const double kHalfDiagonal = std::sqrt(3.0);  // of a cube with half side 1
constexpr double kRoom = 4;                   // times the radius: simplified hulls reach outside the ball of the solid

// Corner k of the eight: the sign of each coordinate from a bit.
Point corner(int k) { return {k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0}; }

enum class Side { outside, cutting, inside };

// Where the cube lies from the plane; "outside" means that no point of the cube is within.
inline Side side(const Eigen::Matrix<double, 1, 4>& plane, const Point& centre, double half) {
  const double distance = plane[0] * centre[0] + plane[1] * centre[1] + plane[2] * centre[2] - plane[3];
  const double reach = half * (std::abs(plane[0]) + std::abs(plane[1]) + std::abs(plane[2]));
  return distance > reach ? Side::outside : distance > -reach ? Side::cutting : Side::inside;
}

bool boxes_apart(const ConvexBody& body, const Point& centre, double half) {
  return ((centre.array() + half < body.low.array()) || (centre.array() - half > body.high.array())).any();
}

}  // namespace

ConvexBody::ConvexBody(const Mesh& hull)
    : planes(hull_planes(hull)), low(hull.vertices.colwise().minCoeff()), high(hull.vertices.colwise().maxCoeff()) {}

OutsideDistance::OutsideDistance(const SurfaceQuery& surface, bool closed, const Sphere& box, double resolution)
    : surface_(surface), closed_(closed), centre_(box.centre), half_(kRoom * box.radius * 1.001), depth_(0) {
  for (double side = 2 * half_; side > resolution; side /= 2) ++depth_;
  cubes_.push_back({static_cast<float>(signed_distance(centre_, 4 * half_, 0)), -1});
}

double OutsideDistance::signed_distance(const Point& centre, double parent_value, double step) const {
  const double distance = surface_.distance(centre, std::abs(parent_value) + step);
  if (!closed_) return distance;
  // No surface between this centre and the parent's: the same side.
  if (std::abs(parent_value) > step && step > 0) return parent_value < 0 ? -distance : distance;
  return surface_.contains(centre) ? -distance : distance;
}

void OutsideDistance::split(std::int32_t cube, const Point& centre, double half) {
  const double value = cubes_[static_cast<std::size_t>(cube)].signed_distance;
  cubes_[static_cast<std::size_t>(cube)].first_child = static_cast<std::int32_t>(cubes_.size());
  for (int k = 0; k < 8; ++k) {
    const double child = signed_distance(centre + half / 2 * corner(k), value, half / 2 * kHalfDiagonal);
    cubes_.push_back({static_cast<float>(child), -1});
  }
}

struct OutsideDistance::Visit {
  OutsideDistance& tree;
  const ConvexBody& body;
  double tolerance;

  // Whether the body meets, in this cube, a point that may be farther than the tolerance. The planes that cut the
  // parent are active_[first, last). cube -1: inside a cube that is too far as a whole, nothing more to ask of
  // distances.
  bool too_far(std::int32_t cube, const Point& centre, double half, int depth, std::size_t first, std::size_t last) {
    bool all_far = cube < 0;
    double value = 0;
    if (!all_far) {
      value = tree.cubes_[static_cast<std::size_t>(cube)].signed_distance;
      if (value + half * kHalfDiagonal <= tolerance) return false;
      all_far = value - half * kHalfDiagonal > tolerance;
    }
    if (boxes_apart(body, centre, half)) return false;
    std::vector<int>& active = tree.active_;
    const std::size_t begin = active.size();
    bool centre_inside = true;
    for (std::size_t i = first; i < last; ++i) {
      const auto plane = body.planes.row(active[i]);
      switch (side(plane, centre, half)) {
        case Side::outside:
          active.resize(begin);
          return false;
        case Side::cutting: {
          const int index = active[i];
          active.push_back(index);
          centre_inside = centre_inside && plane.head<3>().dot(centre) <= plane[3];
          break;
        }
        case Side::inside:
          break;
      }
    }
    const std::size_t end = active.size();
    bool found = depth == tree.depth_ || (centre_inside && (all_far || value > tolerance));
    if (!found) {
      if (!all_far && tree.cubes_[static_cast<std::size_t>(cube)].first_child < 0) tree.split(cube, centre, half);
      const std::int32_t child = all_far ? -1 : tree.cubes_[static_cast<std::size_t>(cube)].first_child;
      for (int k = 0; k < 8 && !found; ++k) {
        found = too_far(all_far ? -1 : child + k, centre + half / 2 * corner(k), half / 2, depth + 1, begin, end);
      }
    }
    active.resize(begin);
    return found;
  }
};

double OutsideDistance::beyond(const ConvexBody& body) const {
  const Point farthest = (body.low - centre_).cwiseAbs().cwiseMax((body.high - centre_).cwiseAbs());
  if (farthest.maxCoeff() <= half_) return 0;
  return farthest.norm() + cubes_.front().signed_distance;  // Distance changes by at most the length of a step.
}

bool OutsideDistance::within(const ConvexBody& body, double tolerance) {
  if (beyond(body) > tolerance) return false;
  active_.resize(static_cast<std::size_t>(body.planes.rows()));
  for (std::size_t i = 0; i < active_.size(); ++i) active_[i] = static_cast<int>(i);
  const std::size_t all = active_.size();
  return !Visit{*this, body, tolerance}.too_far(0, centre_, half_, 0, 0, all);
}

OutsideDistance::Reach OutsideDistance::reach(const ConvexBody& body, double accuracy) {
  struct Entry {
    double bound;
    std::int32_t cube;
    int depth;
    Point centre;
    std::vector<int> planes;
    bool operator<(const Entry& other) const { return bound != other.bound ? bound < other.bound : cube > other.cube; }
  };
  if (const double bound = beyond(body); bound > 0) return {bound, (body.low + body.high) / 2};
  std::priority_queue<Entry> queue;
  const auto consider = [&](std::int32_t cube, int depth, const Point& centre, const std::vector<int>& parent_planes) {
    const double half = std::ldexp(half_, -depth);
    const double bound = cubes_[static_cast<std::size_t>(cube)].signed_distance + half * kHalfDiagonal;
    if (bound <= 0 || boxes_apart(body, centre, half)) return;
    std::vector<int> cutting;
    for (int i : parent_planes) {
      const Side where = side(body.planes.row(i), centre, half);
      if (where == Side::outside) return;
      if (where == Side::cutting) cutting.push_back(i);
    }
    queue.push({bound, cube, depth, centre, std::move(cutting)});
  };
  std::vector<int> all(static_cast<std::size_t>(body.planes.rows()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  consider(0, 0, centre_, all);
  while (!queue.empty()) {
    const Entry top = queue.top();
    queue.pop();
    const double half = std::ldexp(half_, -top.depth);
    if (top.depth == depth_ || 2 * half * kHalfDiagonal <= accuracy) return {top.bound, top.centre};
    if (cubes_[static_cast<std::size_t>(top.cube)].first_child < 0) split(top.cube, top.centre, half);
    const std::int32_t child = cubes_[static_cast<std::size_t>(top.cube)].first_child;
    for (int k = 0; k < 8; ++k) consider(child + k, top.depth + 1, top.centre + half / 2 * corner(k), top.planes);
  }
  return {0, (body.low + body.high) / 2};
}

}  // namespace partwise
