#include "partwise/geometry/constrained_delaunay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numeric>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Position along a Hilbert curve of order 16 over the unit square, so that neighbours in order are neighbours in place.
std::uint64_t hilbert(double unit_x, double unit_y) {
  auto x = static_cast<std::uint32_t>(std::clamp(unit_x, 0.0, 1.0) * 65535);
  auto y = static_cast<std::uint32_t>(std::clamp(unit_y, 0.0, 1.0) * 65535);
  std::uint64_t position = 0;
  for (std::uint32_t s = 32768; s > 0; s /= 2) {
    const std::uint32_t right = (x & s) ? 1 : 0, up = (y & s) ? 1 : 0;
    position += static_cast<std::uint64_t>(s) * s * ((3 * right) ^ up);
    if (!up) {
      if (right) x = 65535 - x, y = 65535 - y;
      std::swap(x, y);
    }
  }
  return position;
}

std::vector<int> hilbert_order(std::span<const Point2> points, const Point2& low, double extent) {
  std::vector<std::pair<std::uint64_t, int>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 unit = (points[i] - low) / extent;
    keys[i] = {hilbert(unit.x(), unit.y()), static_cast<int>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

}  // namespace

ConstrainedDelaunay::ConstrainedDelaunay(std::span<const Point2> points)
    : point_count_(static_cast<int>(points.size())), points_(points.begin(), points.end()) {
  Point2 low(0, 0), high(1, 1);
  if (!points_.empty()) low = high = points_.front();
  for (const Point2& p : points_) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double extent = std::max((high - low).maxCoeff(), 1e-300);
  const Point2 middle = (low + high) / 2;
  points_.push_back(middle + extent * Point2(-60, -50));
  points_.push_back(middle + extent * Point2(60, -50));
  points_.push_back(middle + extent * Point2(0, 70));
  at_.assign(points_.size(), 0);
  triangles_.reserve(2 * points_.size());
  triangles_.push_back({{point_count_, point_count_ + 1, point_count_ + 2}, {-1, -1, -1}});
  for (int vertex : hilbert_order(points, low, extent)) insert_point(vertex);
}

int ConstrainedDelaunay::corner_of(int triangle, int vertex) const {
  const auto& v = triangles_[triangle].v;
  return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
}

void ConstrainedDelaunay::set_neighbour(int triangle, int old_neighbour, int new_neighbour) {
  if (triangle < 0) return;
  for (int& n : triangles_[triangle].neighbour) {
    if (n == old_neighbour) {
      n = new_neighbour;
      return;
    }
  }
}

// Replaces the edge opposite to `corner` by the other diagonal of the two triangles. Both keep their indices.
void ConstrainedDelaunay::flip(int t, int corner) {
  const int u = triangles_[t].neighbour[corner];
  const int a = triangles_[t].v[corner], b = triangles_[t].v[next(corner)], c = triangles_[t].v[previous(corner)];
  const int opposite = [&] {
    for (int i = 0; i < 3; ++i) {
      if (triangles_[u].v[i] != b && triangles_[u].v[i] != c) return i;
    }
    return 0;
  }();
  const int d = triangles_[u].v[opposite];
  const Triangle old_t = triangles_[t], old_u = triangles_[u];
  const int ca = next(corner), ab = previous(corner);      // in t: opposite to b and to c
  const int bd = next(opposite), dc = previous(opposite);  // in u: opposite to c and to b
  // u runs d, c, b: next(opposite) is c, whose opposite edge is b d.
  triangles_[t] = {{a, b, d},
                   {old_u.neighbour[bd], u, old_t.neighbour[ab]},
                   {old_u.fixed[bd], false, old_t.fixed[ab]},
                   old_t.inside};
  triangles_[u] = {{a, d, c},
                   {old_u.neighbour[dc], old_t.neighbour[ca], t},
                   {old_u.fixed[dc], old_t.fixed[ca], false},
                   old_t.inside};
  set_neighbour(old_u.neighbour[bd], u, t);
  set_neighbour(old_t.neighbour[ca], t, u);
  at_[a] = t, at_[b] = t, at_[d] = t, at_[c] = u;
}

void ConstrainedDelaunay::insert_point(int vertex) {
  const Point2& p = points_[vertex];
  // A visibility walk; it ends because the triangulation is Delaunay, and turns at random-looking corners otherwise.
  int t = last_, from = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (int k = 0; k < 3; ++k) {
      const int i = (from + k) % 3;
      const Triangle& triangle = triangles_[t];
      if (orientation(points_[triangle.v[next(i)]], points_[triangle.v[previous(i)]], p) < 0) {
        t = triangle.neighbour[i], moved = true, from = (from + 1) % 3;
        break;
      }
    }
  }
  const Triangle old = triangles_[t];
  int on_edge = -1;
  for (int i = 0; i < 3; ++i) {
    if (orientation(points_[old.v[next(i)]], points_[old.v[previous(i)]], p) == 0) on_edge = i;
  }
  // Three triangles about the point; if it lies on an edge the flat one is then flipped away.
  const int first = t, second = static_cast<int>(triangles_.size()), third = second + 1;
  const auto [a, b, c] = old.v;
  triangles_[first] = {{vertex, b, c}, {old.neighbour[0], second, third}, {old.fixed[0], false, false}};
  triangles_.push_back({{vertex, c, a}, {old.neighbour[1], third, first}, {old.fixed[1], false, false}});
  triangles_.push_back({{vertex, a, b}, {old.neighbour[2], first, second}, {old.fixed[2], false, false}});
  set_neighbour(old.neighbour[1], t, second);
  set_neighbour(old.neighbour[2], t, third);
  at_[vertex] = first, at_[a] = second, at_[b] = third, at_[c] = first;
  std::vector<int> around{first, second, third};
  if (on_edge >= 0) {
    const int flat = around[on_edge];
    around.push_back(triangles_[flat].neighbour[0]);
    flip(flat, 0);
  }
  // Every triangle has the new point at its corner 0; whatever it is flipped against gets it there too.
  while (!around.empty()) {
    const int at = around.back();
    around.pop_back();
    const Triangle& triangle = triangles_[at];
    const int over = triangle.neighbour[0];
    if (over < 0) continue;
    const auto& [p0, p1, p2] = triangle.v;
    int opposite = -1;
    for (int v : triangles_[over].v) {
      if (v != p1 && v != p2) opposite = v;
    }
    if (!inside_circle(points_[p0], points_[p1], points_[p2], points_[opposite])) continue;
    if (side(p0, p1, opposite) <= 0 || side(opposite, p2, p0) <= 0) continue;  // not strictly convex
    flip(at, 0);
    around.push_back(at);
    around.push_back(over);
  }
  last_ = at_[vertex];
}

std::pair<int, int> ConstrainedDelaunay::find_edge(int a, int b) const {
  const int start = at_[a];
  for (int t = start;;) {
    const int i = corner_of(t, a);
    if (triangles_[t].v[next(i)] == b) return {t, previous(i)};
    t = triangles_[t].neighbour[next(i)];  // clockwise or not: all of them are passed
    if (t < 0 || t == start) break;
  }
  // Corners of the frame have a fan that is open: try the other way round.
  for (int t = start; t >= 0;) {
    const int i = corner_of(t, a);
    if (triangles_[t].v[next(i)] == b) return {t, previous(i)};
    t = triangles_[t].neighbour[previous(i)];
    if (t == start) break;
  }
  return {-1, -1};
}

void ConstrainedDelaunay::legalise(std::vector<std::pair<int, int>>& edges) {
  while (!edges.empty()) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    const auto [t, corner] = find_edge(a, b);
    if (t < 0 || triangles_[t].fixed[corner]) continue;
    const int u = triangles_[t].neighbour[corner];
    if (u < 0) continue;
    const int apex = triangles_[t].v[corner];
    int opposite = 0;
    for (int v : triangles_[u].v) {
      if (v != a && v != b) opposite = v;
    }
    if (!inside_circle(points_[a], points_[b], points_[apex], points_[opposite])) continue;
    if (side(apex, a, opposite) <= 0 || side(opposite, b, apex) <= 0) continue;  // not strictly convex
    flip(t, corner);
    edges.insert(edges.end(), {{a, opposite}, {opposite, b}, {b, apex}, {apex, a}});
  }
}

ConstrainedDelaunay::Departure ConstrainedDelaunay::depart(int a, int b) const {
  const int start = at_[a];
  for (int t = start;;) {
    const int i = corner_of(t, a), p = triangles_[t].v[next(i)], q = triangles_[t].v[previous(i)];
    const int left = side(a, b, q), right = side(a, b, p);
    const bool ahead_p = (points_[p] - points_[a]).dot(points_[b] - points_[a]) > 0;
    if (p == b || (right == 0 && ahead_p)) return {t, i, p};
    if (left > 0 && right < 0) return {t, i, -1};
    t = triangles_[t].neighbour[previous(i)];
    PARTWISE_CHECK(t, !=, start);
    PARTWISE_CHECK(t, >=, 0);
  }
}

ConstrainedDelaunay::Walk ConstrainedDelaunay::walk(int a, int b) const {
  Walk result;
  const Departure departure = depart(a, b);
  int t = departure.triangle, i = departure.corner;
  if (departure.on >= 0) {
    result.inside = triangles_[t].inside && triangles_[triangles_[t].neighbour[previous(i)]].inside;
    result.through_vertex = departure.on != b;
    return result;
  }
  result.inside = triangles_[t].inside;
  for (;;) {
    const int p = triangles_[t].v[next(i)], q = triangles_[t].v[previous(i)];
    if (triangles_[t].fixed[i]) result.crossed.emplace_back(p, q);
    t = triangles_[t].neighbour[i];
    int apex_corner = 0;
    for (int k = 0; k < 3; ++k) {
      if (triangles_[t].v[k] != p && triangles_[t].v[k] != q) apex_corner = k;
    }
    const int apex = triangles_[t].v[apex_corner];
    if (apex == b) return result;
    const int where = side(a, b, apex);
    if (where == 0) {
      result.through_vertex = true;
      return result;
    }
    i = corner_of(t, where > 0 ? q : p);  // leave through the edge between the apex and the vertex on the other side
  }
}

bool ConstrainedDelaunay::insert_edge(int a, int b) {
  if (a == b) return true;
  if (has_edge(a, b)) return insert_clear_edge(a, b);
  // Look first, so that nothing is changed in vain.
  std::vector<int> stops{a};
  while (stops.back() != b) {
    const int from = stops.back();
    const Departure departure = depart(from, b);
    int reached = departure.on;
    for (int t = departure.triangle, i = departure.corner; reached < 0;) {
      if (triangles_[t].fixed[i]) return false;
      const int p = triangles_[t].v[next(i)], q = triangles_[t].v[previous(i)];
      t = triangles_[t].neighbour[i];
      int apex = -1;
      for (int v : triangles_[t].v) {
        if (v != p && v != q) apex = v;
      }
      const int where = apex == b ? 0 : side(from, b, apex);
      if (where == 0) reached = apex;
      i = corner_of(t, where > 0 ? q : p);
    }
    stops.push_back(reached);
  }
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) insert_clear_edge(stops[k], stops[k + 1]);
  return true;
}

// No vertex lies on a b and no fixed edge crosses it.
bool ConstrainedDelaunay::insert_clear_edge(int a, int b) {
  std::vector<std::pair<int, int>> renewed;
  if (!has_edge(a, b)) {
    std::deque<std::pair<int, int>> crossing;
    Departure at = depart(a, b);
    for (int t = at.triangle, i = at.corner;;) {
      const int p = triangles_[t].v[next(i)], q = triangles_[t].v[previous(i)];
      crossing.emplace_back(p, q);
      t = triangles_[t].neighbour[i];
      int apex = -1;
      for (int v : triangles_[t].v) {
        if (v != p && v != q) apex = v;
      }
      if (apex == b) break;
      i = corner_of(t, side(a, b, apex) > 0 ? q : p);
    }
    while (!crossing.empty()) {
      const auto [p, q] = crossing.front();
      crossing.pop_front();
      const auto [t, corner] = find_edge(p, q);
      const int u = triangles_[t].neighbour[corner], apex = triangles_[t].v[corner];
      int opposite = -1;
      for (int v : triangles_[u].v) {
        if (v != p && v != q) opposite = v;
      }
      if (side(apex, p, opposite) <= 0 || side(opposite, q, apex) <= 0) {
        crossing.emplace_back(p, q);
        continue;
      }
      flip(t, corner);
      const bool at_end = apex == a || apex == b || opposite == a || opposite == b;
      if (!at_end && side(a, b, apex) * side(a, b, opposite) < 0) {
        crossing.emplace_back(apex, opposite);
      } else {
        renewed.emplace_back(apex, opposite);
      }
    }
  }
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    const auto [t, corner] = find_edge(from, to);
    if (t >= 0) triangles_[t].fixed[corner] = true;
  }
  legalise(renewed);
  return true;
}

void ConstrainedDelaunay::mark_inside() {
  std::vector<int> crossings(triangles_.size(), -1);
  std::deque<int> queue{at_[point_count_]};
  crossings[queue.front()] = 0;
  while (!queue.empty()) {
    const int t = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const int u = triangles_[t].neighbour[i];
      if (u < 0 || crossings[u] >= 0) continue;
      crossings[u] = (crossings[t] + (triangles_[t].fixed[i] ? 1 : 0)) % 2;
      queue.push_back(u);
    }
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) triangles_[t].inside = crossings[t] == 1;
}

std::vector<int> ConstrainedDelaunay::inside_neighbours(int vertex) const {
  std::vector<int> ends;
  const int start = at_[vertex];
  for (int t = start;;) {
    const int i = corner_of(t, vertex), over = triangles_[t].neighbour[previous(i)];
    if (triangles_[t].inside && over >= 0 && triangles_[over].inside) ends.push_back(triangles_[t].v[next(i)]);
    t = over;
    if (t < 0 || t == start) break;
  }
  return ends;
}

}  // namespace partwise
