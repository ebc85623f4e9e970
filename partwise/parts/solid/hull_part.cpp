#include "partwise/parts/solid/hull_part.h"

#include <algorithm>
#include <cmath>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

constexpr int kSketchDirections = 96;

}  // namespace

Vertices extreme_points(const Vertices& points) {
  if (points.rows() <= kSketchDirections) return points;
  static const Eigen::Matrix<double, 3, kSketchDirections> directions = [] {
    Eigen::Matrix<double, 3, kSketchDirections> d;  // a Fibonacci lattice
    for (int i = 0; i < kSketchDirections; ++i) {
      const double z = 1 - (2 * i + 1.0) / kSketchDirections, r = std::sqrt(1 - z * z), around = 2.399963229728653 * i;
      d.col(i) = Eigen::Vector3d(r * std::cos(around), r * std::sin(around), z);
    }
    return d;
  }();
  std::vector<Eigen::Index> extreme;
  for (int i = 0; i < kSketchDirections; ++i) {
    Eigen::Index best;
    (points * directions.col(i)).maxCoeff(&best);
    extreme.push_back(best);
  }
  std::sort(extreme.begin(), extreme.end());
  extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
  return points(extreme, Eigen::all);
}

std::vector<int> vertices_of(const Mesh& mesh, const std::vector<int>& faces) {
  std::vector<int> used;
  used.reserve(3 * faces.size());
  for (int f : faces)
    for (int k = 0; k < 3; ++k) used.push_back(mesh.faces(f, k));
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

Vertices corners_of(const Mesh& mesh, const std::vector<int>& faces) {
  return mesh.vertices(vertices_of(mesh, faces), Eigen::all);
}

void Corners::append(const Vertices& more, const std::vector<int>& their_source) {
  points.conservativeResize(points.rows() + more.rows(), 3);
  points.bottomRows(more.rows()) = more;
  source.insert(source.end(), their_source.begin(), their_source.end());
}

Corners exact_corners(const Mesh& mesh, const HullPart& part) {
  if (!part.thickened) return {part.hull.vertices, part.source};
  std::vector<int> used = vertices_of(mesh, part.faces);  // More than its source, when it took in faces that it held.
  return {mesh.vertices(used, Eigen::all), std::move(used)};
}

void set_hull(HullPart& part, const Corners& corners, double minimum_thickness) {
  ConvexHull hull = convex_hull(corners.points, minimum_thickness);
  part.source.clear();
  for (int corner : hull.source) part.source.push_back(corners.source[corner]);
  part.hull = std::move(hull.mesh);
  part.thickened = hull.thickened;
  part.volume = hull.volume;
  part.sketch = extreme_points(part.hull.vertices);
}

HullPart hull_part(const Mesh& mesh, std::vector<int> faces, double minimum_thickness) {
  std::vector<int> used = vertices_of(mesh, faces);
  HullPart part{.faces = std::move(faces)};
  set_hull(part, {mesh.vertices(used, Eigen::all), std::move(used)}, minimum_thickness);
  return part;
}

}  // namespace partwise
