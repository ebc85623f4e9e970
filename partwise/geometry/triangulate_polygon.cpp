#include "partwise/geometry/triangulate_polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace partwise {
namespace {

using Plane = Eigen::Vector2d;

double turn(const Plane& a, const Plane& b, const Plane& c) {
  const Plane ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// The corners along the coordinate axis in which the vector area is largest, so that the polygon is counter-clockwise.
std::vector<Plane> project(const Vertices& vertices, std::span<const int> polygon) {
  const Point origin = vertices.row(polygon[0]);
  Point area = Point::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point a = vertices.row(polygon[i]) - origin, b = vertices.row(polygon[i + 1]) - origin;
    area += a.cross(b);
  }
  int axis = 0;
  area.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (area[axis] < 0) std::swap(u, v);
  std::vector<Plane> corners;
  corners.reserve(polygon.size());
  for (const int index : polygon) corners.emplace_back(vertices(index, u) - origin[u], vertices(index, v) - origin[v]);
  return corners;
}

// Every corner turns left or goes straight, and the directions go round once only (a pentagram turns left too).
bool is_convex(const std::vector<Plane>& corners) {
  const std::size_t n = corners.size();
  // How often the edges change between up and down; edges along the x axis do not count.
  int changes = 0;
  bool previous_up = false;
  for (std::size_t i = 0; i < n; ++i)
    if (corners[i].y() != corners[(i + 1) % n].y()) previous_up = corners[(i + 1) % n].y() > corners[i].y();
  for (std::size_t i = 0; i < n; ++i) {
    const Plane &a = corners[i], &b = corners[(i + 1) % n], &c = corners[(i + 2) % n];
    if (turn(a, b, c) < 0) return false;
    if (a.y() != b.y()) {
      const bool up = b.y() > a.y();
      changes += up != previous_up;
      previous_up = up;
    }
  }
  return changes <= 2;
}

// Clips ears of a polygon held as a ring of its corners that are left.
class EarClipping {
 public:
  explicit EarClipping(const std::vector<Plane>& corners)
      : corners_(corners), next_(corners.size()), previous_(corners.size()) {
    const int n = static_cast<int>(corners.size());
    for (int i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    for (int i = 0; i < n; ++i)
      if (!is_left_turn(i)) reflex_.push_back(i);
    ear_.resize(corners.size());
    for (int i = 0; i < n; ++i) ear_[i] = is_ear(i);
  }

  template <typename Emit>
  void run(const Emit& emit) {
    int left = static_cast<int>(corners_.size());
    int at = 0, passed = 0;
    while (left > 3) {
      // A full turn without an ear: the polygon crosses itself or is flat, and any cut is as good as another.
      if (!ear_[at] && passed < left) {
        at = next_[at];
        ++passed;
        continue;
      }
      const int before = previous_[at], after = next_[at];
      emit(before, at, after);
      next_[before] = after;
      previous_[after] = before;
      std::erase_if(reflex_, [&](int i) { return i == at || ((i == before || i == after) && is_left_turn(i)); });
      ear_[before] = is_ear(before);
      ear_[after] = is_ear(after);
      --left;
      passed = 0;
      at = after;
    }
    emit(previous_[at], at, next_[at]);
  }

 private:
  bool is_left_turn(int i) const { return turn(corners_[previous_[i]], corners_[i], corners_[next_[i]]) > 0; }

  bool is_ear(int i) const {
    if (!is_left_turn(i)) return false;
    const Plane &a = corners_[previous_[i]], &b = corners_[i], &c = corners_[next_[i]];
    // Only reflex corners can lie inside. Those that coincide with a corner of the ear (bridges to holes) do not count.
    return std::none_of(reflex_.begin(), reflex_.end(), [&](int j) {
      const Plane& p = corners_[j];
      if (p == a || p == b || p == c) return false;
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  const std::vector<Plane>& corners_;
  std::vector<int> next_, previous_, reflex_;
  std::vector<char> ear_;
};

}  // namespace

void triangulate_polygon(const Vertices& vertices, std::span<const int> polygon,
                         std::vector<std::array<int, 3>>& triangles) {
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  const std::vector<Plane> corners = project(vertices, polygon);
  if (is_convex(corners)) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
  } else {
    EarClipping(corners).run([&](int a, int b, int c) { triangles.push_back({polygon[a], polygon[b], polygon[c]}); });
  }
}

}  // namespace partwise
