#include "partwise/parts/solid/concavity_polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

#include "partwise/parts/planar/planar_hull.h"

namespace partwise {
namespace {

bool properly_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

bool self_intersects(std::span<const Point2> v) {
  for (std::size_t i = 0; i + 1 < v.size(); ++i) {
    const double low = std::min(v[i].x(), v[i + 1].x()), high = std::max(v[i].x(), v[i + 1].x());
    for (std::size_t j = i + 2; j + 1 < v.size(); ++j) {
      if (std::min(v[j].x(), v[j + 1].x()) > high || std::max(v[j].x(), v[j + 1].x()) < low) continue;
      if (properly_cross(v[i], v[i + 1], v[j], v[j + 1])) return true;
    }
  }
  return false;
}

// The largest distance of a vertex to the hull edge that spans it: how far the polyline bulges into the polygon.
double largest_bulge(std::span<const Point2> v) {
  std::vector<int> hull = planar_hull(v);
  std::sort(hull.begin(), hull.end());
  double bulge = 0;
  for (std::size_t h = 0; h + 1 < hull.size(); ++h)
    for (int m = hull[h] + 1; m < hull[h + 1]; ++m)
      bulge = std::max(bulge, distance_to_segment(v[m], v[hull[h]], v[hull[h + 1]]));
  return bulge;
}

// Shortest paths to the base inside the simple polygon, over the graph of mutually visible vertices.
std::vector<double> shortest_path_concavity(std::span<const Point2> v) {
  const std::size_t n = v.size();
  const double length = v.back().x();
  double size = 0;
  for (const Point2& p : v) size = std::max(size, p.cwiseAbs().maxCoeff());
  const double touch = 1e-12 * size;
  const auto inside = [&](const Point2& p) {  // or on the boundary
    bool odd = false;
    for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
      if (distance_to_segment(p, v[j], v[i]) <= touch) return true;
      if ((v[i].y() > p.y()) == (v[j].y() > p.y())) continue;
      if (p.x() < (v[j].x() - v[i].x()) * (p.y() - v[i].y()) / (v[j].y() - v[i].y()) + v[i].x()) odd = !odd;
    }
    return odd;
  };
  std::vector<double> stops;
  const auto visible = [&](const Point2& p, const Point2& q) {
    for (std::size_t i = 0; i + 1 < n; ++i)
      if (properly_cross(p, q, v[i], v[i + 1])) return false;
    // It crosses no edge, but may leave and enter again at vertices: no piece between two of them may be outside.
    const double length2 = (q - p).squaredNorm();
    if (length2 == 0) return true;
    stops.assign({0, 1});
    for (const Point2& corner : v) {
      const double t = (corner - p).dot(q - p) / length2;
      if (t > 0 && t < 1 && (corner - p - t * (q - p)).norm() <= touch) stops.push_back(t);
    }
    std::sort(stops.begin(), stops.end());
    for (std::size_t i = 0; i + 1 < stops.size(); ++i)
      if (!inside(p + (stops[i] + stops[i + 1]) / 2 * (q - p))) return false;
    return true;
  };
  std::vector<double> distance(n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 foot(std::clamp(v[i].x(), 0.0, length), 0);
    if (v[i].y() <= 0 || i == 0 || i + 1 == n || visible(v[i], foot)) distance[i] = (v[i] - foot).norm();
  }
  std::vector<char> done(n, 0);
  for (std::size_t round = 0; round < n; ++round) {
    std::size_t nearest = n;
    for (std::size_t i = 0; i < n; ++i)
      if (!done[i] && std::isfinite(distance[i]) && (nearest == n || distance[i] < distance[nearest])) nearest = i;
    if (nearest == n) break;
    done[nearest] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i]) continue;
      const double through = distance[nearest] + (v[i] - v[nearest]).norm();
      const bool neighbours = i + 1 == nearest || nearest + 1 == i;
      if (through < distance[i] && (neighbours || visible(v[i], v[nearest]))) distance[i] = through;
    }
  }
  return distance;
}

}  // namespace

std::vector<Point2> flatten_valley(std::span<const Point> path) {
  std::vector<Point2> flat(path.size());
  const Point& a = path.front();
  const Point ab = path.back() - a;
  const double length = ab.norm();
  const Point along = length > 0 ? Point(ab / length) : Point::Zero();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double x = (path[i] - a).dot(along);
    flat[i] = {x, (path[i] - a - std::clamp(x, 0.0, length) * along).norm()};
  }
  flat.front() = {0, 0};
  flat.back() = {length, 0};
  return flat;
}

std::vector<double> valley_concavity(std::span<const Point2> valley, double tolerance) {
  const bool turns_back = std::adjacent_find(valley.begin(), valley.end(), [](const Point2& p, const Point2& q) {
                            return q.x() < p.x();
                          }) != valley.end();
  if (!turns_back) {
    std::vector<double> height(valley.size());
    std::transform(valley.begin(), valley.end(), height.begin(), [](const Point2& p) { return p.y(); });
    return height;
  }
  if (largest_bulge(valley) > tolerance || self_intersects(valley)) return hierarchical_concavity(valley, tolerance);
  return shortest_path_concavity(valley);
}

double prefix_concavity(std::span<const Point2> valley, std::size_t k) {
  const auto prefix = valley.first(k + 1);
  const std::vector<int> hull = planar_hull(prefix);
  double concavity = 0;
  for (std::size_t h = 0; h < hull.size(); ++h) {
    const int i = hull[h], j = hull[(h + 1) % hull.size()];
    for (int m = i + 1; m < j; ++m)
      concavity = std::max(concavity, distance_to_segment(prefix[m], prefix[i], prefix[j]));
  }
  return concavity;
}

namespace {

// The valley seen from its other end: mirrored, so that its bridges are met counter-clockwise again.
std::vector<Point2> reversed(std::span<const Point2> valley) {
  std::vector<Point2> back(valley.rbegin(), valley.rend());
  for (Point2& p : back) p.x() = valley.back().x() - p.x();
  return back;
}

// The vertex of least residual concavity. One concavity rises with k, the other falls, so the least is where they meet.
std::size_t least_residual(std::span<const Point2> valley, std::span<const Point2> back) {
  const std::size_t last = valley.size() - 1;
  std::size_t low = 0, high = last;  // prefix(low) <= suffix(low); prefix(high) >= suffix(high)
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (prefix_concavity(valley, middle) <= prefix_concavity(back, last - middle) ? low : high) = middle;
  }
  const auto residual = [&](std::size_t k) {
    return std::max(prefix_concavity(valley, k), prefix_concavity(back, last - k));
  };
  // Both sides of the crossing, and the plateau of equal values around it: there the deeper vertex wins.
  std::size_t best = residual(low) < residual(high) ? low : high;
  const double least = residual(best);
  for (const int step : {-1, 1}) {
    std::size_t k = best;
    for (int tries = 0; tries < 8; ++tries) {
      if ((step < 0 && k == 0) || (step > 0 && k == last)) break;
      k += static_cast<std::size_t>(step);
      if (residual(k) > least + 1e-12) break;
      if (valley[k].y() > valley[best].y()) best = k;
    }
  }
  return best;
}

// The largest k whose prefix stays below the tolerance.
std::size_t longest_shallow_prefix(std::span<const Point2> valley, double tolerance) {
  std::size_t low = 1, high = valley.size() - 1;  // An edge alone has no concavity.
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (prefix_concavity(valley, middle) < tolerance ? low : high) = middle;
  }
  return low;
}

}  // namespace

double residual_concavity(std::span<const Point2> valley, std::size_t k) {
  return std::max(prefix_concavity(valley, k), prefix_concavity(reversed(valley), valley.size() - 1 - k));
}

ValleySeparators valley_separators(std::span<const Point2> valley, double tolerance) {
  const std::vector<Point2> back = reversed(valley);
  const std::size_t last = valley.size() - 1;
  const std::size_t split = least_residual(valley, back);
  if (std::max(prefix_concavity(valley, split), prefix_concavity(back, last - split)) < tolerance)
    return {split, split};

  const std::size_t i = longest_shallow_prefix(valley, tolerance), j = longest_shallow_prefix(back, tolerance);
  const auto separator = [](std::span<const Point2> from_end, std::size_t k) {
    // The sub-valley in its own frame: its bridge joins its two ends.
    const auto sub = from_end.first(k + 1);
    std::vector<Point2> frame(sub.size());
    const Point2 along = (sub.back() - sub.front()).normalized();
    for (std::size_t m = 0; m < sub.size(); ++m)
      frame[m] = {along.dot(sub[m] - sub.front()), cross(along, sub[m] - sub.front())};
    return k < 2 ? k : least_residual(frame, reversed(frame));
  };
  const std::size_t first = std::max<std::size_t>(1, separator(valley, i));
  const std::size_t second = last - std::max<std::size_t>(1, separator(back, j));
  if (first >= second) return {split, split};
  return {first, second};
}

}  // namespace partwise
