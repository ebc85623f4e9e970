#include "partwise/geometry/triangle_crossing.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr double on_plane = 1e-13;  // of the sizes multiplied: so near to a plane, a point is taken to lie in it

double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return (b - a).cross(c - a).dot(d - a);
}

Triangle triangle_of(const Mesh& mesh, Eigen::Index face) {
  return {mesh.vertices.row(mesh.faces(face, 0)), mesh.vertices.row(mesh.faces(face, 1)),
          mesh.vertices.row(mesh.faces(face, 2))};
}

using Boxes = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;  // low x, y, z, high x, y, z of each face

Boxes boxes_of(const Mesh& mesh) {
  Boxes boxes(mesh.faces.rows(), 6);
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Triangle t = triangle_of(mesh, f);
    boxes.row(f) << t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  }
  return boxes;
}

bool meet(const double* a, const double* b) {
  return a[0] <= b[3] && a[1] <= b[4] && a[2] <= b[5] && b[0] <= a[3] && b[1] <= a[4] && b[2] <= a[5];
}

// Two faces of one mesh. Those that share an edge cannot cross; those that share a vertex cross elsewhere only where
// the edge opposite of it, in one, meets the other.
bool faces_cross(const Mesh& mesh, Eigen::Index f, Eigen::Index g) {
  int shared = 0, in_f = 0, in_g = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (mesh.faces(f, i) == mesh.faces(g, j)) ++shared, in_f = i, in_g = j;
  if (shared > 1) return false;
  const Triangle a = triangle_of(mesh, f), b = triangle_of(mesh, g);
  if (shared == 0) return triangles_cross(a, b);
  const auto opposite = [](const Triangle& t, int corner, const Triangle& other) {
    return segment_crosses_triangle(t[static_cast<std::size_t>(corner + 1) % 3],
                                    t[static_cast<std::size_t>(corner + 2) % 3], other);
  };
  return opposite(a, in_f, b) || opposite(b, in_g, a);
}

// Whether test(f, g) holds for any pair of faces whose boxes meet.
template <typename Test>
bool any_pair(const Boxes& a, const Boxes& b, const Test& test) {
  std::atomic<bool> found = false;
  tbb::parallel_for(Eigen::Index{0}, b.rows(), [&](Eigen::Index g) {
    for (Eigen::Index f = 0; f < a.rows() && !found; ++f)
      if (meet(&a(f, 0), &b(g, 0)) && test(f, g)) found = true;
  });
  return found;
}

}  // namespace

bool segment_crosses_triangle(const Point& p, const Point& q, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const double edges = on_plane * (b - a).norm() * (c - a).norm();
  const auto side = [&](const Point& end) {
    const double above = volume(a, b, c, end);
    return std::abs(above) <= edges * (end - a).norm() ? 0 : above > 0 ? 1 : -1;
  };
  // Where both lie in the plane what follows would be noise.
  const int side_p = side(p), side_q = side(q);
  if (side_p == side_q) return false;
  const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool triangles_cross(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_crosses_triangle(a[i], a[(i + 1) % 3], b) || segment_crosses_triangle(b[i], b[(i + 1) % 3], a))
      return true;
  }
  return false;
}

bool crosses_itself(const Mesh& mesh) {
  const Boxes boxes = boxes_of(mesh);
  return any_pair(boxes, boxes, [&](Eigen::Index f, Eigen::Index g) { return f < g && faces_cross(mesh, f, g); });
}

bool encloses(const Mesh& outer, const Mesh& inner) {
  const Components components = face_components_by_vertex(inner);
  std::vector<bool> seen(static_cast<std::size_t>(components.count));
  for (Eigen::Index f = 0; f < inner.faces.rows(); ++f) {
    const auto label = static_cast<std::size_t>(components.label[static_cast<std::size_t>(f)]);
    if (seen[label]) continue;
    seen[label] = true;
    if (solid_angle_winding(outer, inner.vertices.row(inner.faces(f, 0))) < 0.75) return false;
  }
  return !any_pair(boxes_of(inner), boxes_of(outer), [&](Eigen::Index f, Eigen::Index g) {
    return triangles_cross(triangle_of(inner, f), triangle_of(outer, g));
  });
}

}  // namespace partwise
