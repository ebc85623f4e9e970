#include "partwise/geometry/extrude.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/constrained_delaunay.h"

namespace partwise {
namespace {

// The corners of all rings, each place once, and the sides as pairs of them with the polygon on the left.
struct Outline {
  std::vector<Point2> corners;
  std::vector<std::pair<int, int>> sides;
};

Outline outline_of(const Polygon& polygon) {
  Outline outline;
  std::map<std::pair<double, double>, int> known;
  const auto add = [&](const Ring& ring) {
    std::vector<int> numbers;
    for (const auto& corner : ring.rowwise()) {
      const auto [place, is_new] =
          known.try_emplace({corner.x(), corner.y()}, static_cast<int>(outline.corners.size()));
      if (is_new) outline.corners.emplace_back(corner.x(), corner.y());
      numbers.push_back(place->second);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
      outline.sides.emplace_back(numbers[i], numbers[(i + 1) % numbers.size()]);
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
  return outline;
}

std::vector<std::array<int, 3>> triangles_of(const Outline& outline) {
  ConstrainedDelaunay delaunay(outline.corners);
  for (const auto& [a, b] : outline.sides) delaunay.insert_edge(a, b);
  delaunay.mark_inside();
  std::vector<std::array<int, 3>> inside;
  for (const auto& triangle : delaunay.triangles()) {
    if (triangle.inside) inside.push_back(triangle.v);
  }
  return inside;
}

}  // namespace

Mesh prism(const Polygon& polygon, double low, double high) {
  PARTWISE_CHECK(low, <, high);
  const Outline outline = outline_of(polygon);
  const std::vector<std::array<int, 3>> cap = triangles_of(outline);
  const auto n = static_cast<int>(outline.corners.size());
  Mesh mesh;
  mesh.vertices.resize(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    const Point2& corner = outline.corners[static_cast<std::size_t>(i)];
    mesh.vertices.row(i) << corner.x(), corner.y(), low;
    mesh.vertices.row(n + i) << corner.x(), corner.y(), high;
  }
  mesh.faces.resize(static_cast<Eigen::Index>(2 * (cap.size() + outline.sides.size())), 3);
  Eigen::Index face = 0;
  for (const auto& [a, b, c] : cap) {
    mesh.faces.row(face++) << c, b, a;
    mesh.faces.row(face++) << n + a, n + b, n + c;
  }
  for (const auto& [a, b] : outline.sides) {
    mesh.faces.row(face++) << a, b, n + b;
    mesh.faces.row(face++) << a, n + b, n + a;
  }
  return mesh;
}

}  // namespace partwise
