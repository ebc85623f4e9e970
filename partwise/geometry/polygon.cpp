#include "partwise/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "partwise/geometry/orientation.h"

namespace partwise {
namespace {

void drop_repeats(Ring& ring) {
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < ring.rows(); ++i) {
    if (kept == 0 || ring.row(i) != ring.row(kept - 1)) ring.row(kept++) = ring.row(i);
  }
  while (kept > 1 && ring.row(kept - 1) == ring.row(0)) --kept;
  ring.conservativeResize(kept, 2);
}

void turn(Ring& ring, bool counter_clockwise) {
  if ((signed_area(ring) > 0) != counter_clockwise) ring = ring.colwise().reverse().eval();
}

Circle through(const Point2& a, const Point2& b) { return {(a + b) / 2, (a - b).norm() / 2}; }

Circle through(const Point2& a, const Point2& b, const Point2& c) {
  const Point2 ab = b - a, ac = c - a;
  const double twice = 2 * cross(ab, ac);
  if (twice == 0) {  // on one line: the two farthest apart
    Circle best = through(a, b);
    for (const Circle& other : {through(b, c), through(a, c)}) {
      if (other.radius > best.radius) best = other;
    }
    return best;
  }
  const Point2 centre = a + Point2(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                                   ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) /
                                twice;
  return {centre, (centre - a).norm()};
}

bool holds(const Circle& circle, const Point2& p) { return (p - circle.centre).norm() <= circle.radius * (1 + 1e-12); }

// 1 inside, 0 on the ring, -1 outside.
int where(const Ring& ring, const Point2& p) {
  bool inside = false;
  for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
    const Point2 a = ring.row(j), b = ring.row(i);
    const int side = orientation(a, b, p);
    if (side == 0 && (p - a).dot(p - b) <= 0) return 0;
    if ((a.y() > p.y()) != (b.y() > p.y()) && (side > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside ? 1 : -1;
}

struct Box {
  Eigen::Vector2d low, high;
  bool holds(const Box& other) const {
    return (low.array() <= other.low.array()).all() && (high.array() >= other.high.array()).all();
  }
};

// Whether `outer` encloses `inner`; the rings do not cross.
bool encloses(const Ring& outer, const Ring& inner) {
  for (Eigen::Index i = 0; i < inner.rows(); ++i) {
    if (const int at = where(outer, inner.row(i).transpose()); at != 0) return at > 0;
  }
  for (Eigen::Index i = 0; i < inner.rows(); ++i) {  // every corner touches: judge by the middles of the sides
    const Point2 middle = (inner.row(i) + inner.row((i + 1) % inner.rows())).transpose() / 2;
    if (const int at = where(outer, middle); at != 0) return at > 0;
  }
  return false;
}

}  // namespace

double signed_area(const Ring& ring) {
  double twice = 0;
  for (Eigen::Index i = 1; i + 1 < ring.rows(); ++i) {
    twice += cross((ring.row(i) - ring.row(0)).transpose(), (ring.row(i + 1) - ring.row(0)).transpose());
  }
  return twice / 2;
}

double area(const Polygon& polygon) {
  double sum = std::abs(signed_area(polygon.outer));
  for (const Ring& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  return sum;
}

double area(std::span<const Polygon> polygons) {
  return std::accumulate(polygons.begin(), polygons.end(), 0.0,
                         [](double sum, const Polygon& polygon) { return sum + area(polygon); });
}

void normalise(Polygons& polygons) {
  for (Polygon& polygon : polygons) {
    drop_repeats(polygon.outer);
    turn(polygon.outer, true);
    for (Ring& hole : polygon.holes) {
      drop_repeats(hole);
      turn(hole, false);
    }
    std::erase_if(polygon.holes, [](const Ring& hole) { return hole.rows() < 3; });
  }
  std::erase_if(polygons, [](const Polygon& polygon) { return polygon.outer.rows() < 3; });
}

Eigen::AlignedBox2d bounding_box(std::span<const Polygon> polygons) {
  Eigen::AlignedBox2d box;  // holes lie inside
  for (const Polygon& polygon : polygons)
    for (const auto& corner : polygon.outer.rowwise()) box.extend(Eigen::Vector2d(corner));
  return box;
}

Circle enclosing_circle(std::span<const Polygon> polygons) {
  std::vector<Point2> points;
  for (const Polygon& polygon : polygons) {
    for (Eigen::Index i = 0; i < polygon.outer.rows(); ++i) points.emplace_back(polygon.outer.row(i).transpose());
  }
  if (points.empty()) return {};
  std::shuffle(points.begin(), points.end(), std::mt19937(1));
  Circle circle{points[0], 0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (holds(circle, points[i])) continue;
    circle = {points[i], 0};
    for (std::size_t j = 0; j < i; ++j) {
      if (holds(circle, points[j])) continue;
      circle = through(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!holds(circle, points[k])) circle = through(points[i], points[j], points[k]);
      }
    }
  }
  return circle;
}

Polygons assemble_polygons(std::vector<Ring> rings, FillRule rule) {
  for (Ring& ring : rings) drop_repeats(ring);
  std::erase_if(rings, [](const Ring& ring) { return ring.rows() < 3; });
  // From large to small, so that whatever encloses a ring comes before it.
  std::stable_sort(rings.begin(), rings.end(),
                   [](const Ring& a, const Ring& b) { return std::abs(signed_area(a)) > std::abs(signed_area(b)); });
  std::vector<Box> boxes;
  boxes.reserve(rings.size());
  for (const Ring& ring : rings) boxes.push_back({ring.colwise().minCoeff(), ring.colwise().maxCoeff()});
  std::vector<int> winding(rings.size()), depth(rings.size()), owner(rings.size(), -1);
  Polygons polygons;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    int parent = -1;
    for (std::size_t j = i; j-- > 0 && parent < 0;) {
      if (boxes[j].holds(boxes[i]) && encloses(rings[j], rings[i])) parent = static_cast<int>(j);
    }
    const int turns = signed_area(rings[i]) > 0 ? 1 : -1;
    winding[i] = (parent < 0 ? 0 : winding[parent]) + turns;
    depth[i] = (parent < 0 ? 0 : depth[parent]) + 1;
    const auto filled = [&](int ring) {
      return ring >= 0 && (rule == FillRule::even_odd ? depth[ring] % 2 == 1 : winding[ring] != 0);
    };
    const bool outside = filled(parent), inside = filled(static_cast<int>(i));
    owner[i] = parent < 0 ? -1 : owner[parent];
    if (inside && !outside) {
      owner[i] = static_cast<int>(polygons.size());
      polygons.push_back({rings[i], {}});
    } else if (outside && !inside) {
      polygons[owner[i]].holes.push_back(rings[i]);
    }
  }
  normalise(polygons);
  return polygons;
}

}  // namespace partwise
