#include "partwise/geometry/mesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>

namespace partwise {
namespace {

// The smallest sphere through all of up to four support points: centre = q0 + sum of l_i (q_i - q0), equidistant.
Sphere circumsphere(const std::array<Point, 4>& support, int count) {
  if (count == 0) return {Point::Zero(), -1};
  Eigen::Matrix3d gram = Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int i = 1; i < count; ++i) {
    for (int j = 1; j < count; ++j) gram(i - 1, j - 1) = 2 * (support[i] - support[0]).dot(support[j] - support[0]);
    right[i - 1] = (support[i] - support[0]).squaredNorm();
  }
  const Eigen::Vector3d l = gram.fullPivLu().solve(right);
  Point offset = Point::Zero();
  for (int i = 1; i < count; ++i) offset += l[i - 1] * (support[i] - support[0]);
  return {support[0] + offset, offset.norm()};
}

// Welzl's recursion with move to front; at most four levels deep.
Sphere smallest(const Vertices& points, std::vector<int>& order, std::size_t end, std::array<Point, 4>& support,
                int count, double slack) {
  Sphere sphere = circumsphere(support, count);
  if (count == 4) return sphere;
  for (std::size_t i = 0; i < end; ++i) {
    const Point p = points.row(order[i]);
    if (sphere.radius >= 0 && (p - sphere.centre).norm() <= sphere.radius + slack) continue;
    support[count] = p;
    sphere = smallest(points, order, i, support, count + 1, slack);
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i),
                order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return sphere;
}

}  // namespace

Sphere bounding_sphere(const Mesh& mesh) {
  if (mesh.faces.rows() == 0) return {};
  std::vector<char> used(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  for (int v : mesh.faces.reshaped()) used[v] = 1;
  std::vector<int> order;
  for (int v = 0; v < mesh.vertices.rows(); ++v)
    if (used[v]) order.push_back(v);

  // Only a few points matter: those farthest out of the sphere so far are added one by one (Gaertner 1999).
  const auto farthest_from = [&](const Point& centre) {
    int farthest = order.front();
    double distance = -1;
    for (int v : order) {
      const double d = (mesh.vertices.row(v) - centre).squaredNorm();
      if (d > distance) distance = d, farthest = v;
    }
    return farthest;
  };
  std::vector<int> active{farthest_from(mesh.vertices.row(order.front()))};
  const Point first = mesh.vertices.row(active.front());
  const double slack = 1e-12 * (mesh.vertices.row(farthest_from(first)) - first).norm();
  for (;;) {
    std::array<Point, 4> support;
    Sphere sphere = smallest(mesh.vertices, active, active.size(), support, 0, slack);
    const int farthest = farthest_from(sphere.centre);
    const double distance = (mesh.vertices.row(farthest) - sphere.centre).norm();
    if (distance <= sphere.radius + slack || std::ranges::find(active, farthest) != active.end())
      return {sphere.centre, std::max(sphere.radius, distance)};
    active.insert(active.begin(), farthest);
  }
}

double signed_volume(const Mesh& mesh) {
  if (mesh.faces.rows() == 0) return 0;
  const Point origin = mesh.vertices.row(mesh.faces(0, 0));  // Near the mesh, so that far meshes lose no digits.
  double six = 0;
  for (const auto& f : mesh.faces.rowwise()) {
    const Point a = mesh.vertices.row(f[0]) - origin, b = mesh.vertices.row(f[1]) - origin,
                c = mesh.vertices.row(f[2]) - origin;
    six += a.dot(b.cross(c));
  }
  return six / 6;
}

std::vector<double> face_areas(const Mesh& mesh) {
  std::vector<double> areas;
  areas.reserve(static_cast<std::size_t>(mesh.faces.rows()));
  for (const auto& f : mesh.faces.rowwise()) {
    const Point a = mesh.vertices.row(f[0]), b = mesh.vertices.row(f[1]), c = mesh.vertices.row(f[2]);
    const Point normal = (b - a).cross(c - a);
    // The square of an area may be no number; Eigen's stableNorm adds up as the vector happens to lie in memory.
    areas.push_back(std::hypot(normal[0], normal[1], normal[2]) / 2);
  }
  return areas;
}

}  // namespace partwise
