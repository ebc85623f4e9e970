#include "partwise/parts/applications/cage_deformer.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/solid_angle.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

// A face as seen from a point at the origin.
struct SeenTriangle {
  SeenTriangle(const Mesh& cage, Eigen::Index face, const Point& from) {
    for (int k = 0; k < 3; ++k) {
      corner[k] = cage.vertices.row(cage.faces(face, k)) - from;
      length[k] = corner[k].norm();
    }
    solid_angle = partwise::solid_angle(corner);
  }

  Triangle corner;
  std::array<double, 3> length;
  double solid_angle = 0;  // positive when the face is seen from within
};

// Adds the Green coordinates of the face, times 4 pi: of its three corners, and of its normal.
void add_green(const SeenTriangle& seen, std::array<double, 3>& of_corner, double& of_normal) {
  const auto& [a, b, c] = seen.corner;
  const Point across = (b - a).cross(c - a);
  const double area2 = across.norm();
  const Point normal = across / area2;
  const double height = normal.dot(a);
  const Point foot = height * normal;
  // Edge k is opposite corner k. In the plane: the outward normal of each edge, the distance of the foot inside of it,
  // and the integral of 1/r along it.
  std::array<Point, 3> outward;
  std::array<double, 3> inside, integral;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t from = (k + 1) % 3, to = (k + 2) % 3;
    const Point edge = seen.corner[to] - seen.corner[from];
    const double length = edge.norm();
    outward[k] = edge.cross(normal) / length;
    inside[k] = outward[k].dot(seen.corner[from] - foot);
    const double both = seen.length[from] + seen.length[to];
    integral[k] = std::log((both + length) / std::max(both - length, 1e-300));
  }
  double potential = -height * seen.solid_angle;
  for (std::size_t k = 0; k < 3; ++k) potential += inside[k] * integral[k];
  of_normal = potential;
  // The hat of corner k falls to 0 on edge k: its value at the foot, and its slope.
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge_length = (seen.corner[(k + 2) % 3] - seen.corner[(k + 1) % 3]).norm();
    const double slope = edge_length / area2;
    double sum = slope * inside[k] * seen.solid_angle;
    for (std::size_t e = 0; e < 3; ++e) sum += height * slope * outward[k].dot(outward[e]) * integral[e];
    of_corner[k] = sum;
  }
}

// Adds the mean value weights of the face, before they are divided by their sum.
void add_mean_value(const SeenTriangle& seen, std::array<double, 3>& of_corner) {
  of_corner = {0, 0, 0};
  const auto& v = seen.corner;
  std::array<Point, 3> side;  // v[k + 1] x v[k + 2], the normal of the plane through the point and edge k
  Point mean = Point::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    side[k] = v[(k + 1) % 3].cross(v[(k + 2) % 3]);
    const double sine = side[k].norm(), cosine = v[(k + 1) % 3].dot(v[(k + 2) % 3]);
    if (sine > 0) mean += 0.5 * std::atan2(sine, cosine) / sine * side[k];
  }
  const double volume = v[0].dot(side[0]);
  // Seen edge-on the shadow has no area, and its corners no weight.
  if (std::abs(volume) <= 1e-13 * seen.length[0] * seen.length[1] * seen.length[2]) return;
  for (std::size_t k = 0; k < 3; ++k) of_corner[k] = side[k].dot(mean) / volume;
}

void check_cage(const Mesh& cage) {
  if (!is_watertight(cage))
    throw InputError("cage", "is not closed", "give a watertight one, as partwise cage makes it");
  for (Eigen::Index f = 0; f < cage.faces.rows(); ++f) {
    const Point a = cage.vertices.row(cage.faces(f, 0)), b = cage.vertices.row(cage.faces(f, 1)),
                c = cage.vertices.row(cage.faces(f, 2));
    if (!((b - a).cross(c - a).norm() > 0))
      throw InputError("cage", fmt::format("face {} has no area", f), "remove such faces");
  }
}

// How much each face was stretched (Lipman, Levin, Cohen-Or 2008, section 3): the root mean square of the singular
// values of its map.
double stretch(const Point& u, const Point& v, const Point& u_now, const Point& v_now) {
  const double squared =
      u_now.squaredNorm() * v.squaredNorm() - 2 * u_now.dot(v_now) * u.dot(v) + v_now.squaredNorm() * u.squaredNorm();
  return std::sqrt(std::max(squared, 0.0) / 2) / u.cross(v).norm();
}

}  // namespace

CageDeformer::CageDeformer(const Vertices& points, const Mesh& cage, CageCoordinates kind, const Progress& progress)
    : cage_(cage) {
  check_cage(cage);
  const bool green = kind == CageCoordinates::green;
  vertex_weights_ = Eigen::MatrixXd::Zero(points.rows(), cage.vertices.rows());
  face_weights_ = Eigen::MatrixXd::Zero(green ? points.rows() : 0, green ? cage.faces.rows() : 0);
  std::vector<char> inside(static_cast<std::size_t>(points.rows()));
  SharedProgress shared(progress, "coordinates", static_cast<int>(points.rows()));
  tbb::parallel_for(Eigen::Index{0}, points.rows(), [&](Eigen::Index i) {
    double solid_angle = 0;
    for (Eigen::Index f = 0; f < cage.faces.rows(); ++f) {
      const SeenTriangle seen(cage, f, points.row(i));
      solid_angle += seen.solid_angle;
      std::array<double, 3> of_corner;
      if (green) {
        double of_normal;
        add_green(seen, of_corner, of_normal);
        face_weights_(i, f) = of_normal / (4 * std::numbers::pi);
      } else {
        add_mean_value(seen, of_corner);
      }
      for (int k = 0; k < 3; ++k) vertex_weights_(i, cage.faces(f, k)) += of_corner[static_cast<std::size_t>(k)];
    }
    inside[static_cast<std::size_t>(i)] = std::abs(solid_angle / (4 * std::numbers::pi) - 1) < 1e-6;
    vertex_weights_.row(i) /= vertex_weights_.row(i).sum();
    shared.add(1);
  });
  const auto first = std::find(inside.begin(), inside.end(), 0);
  if (first != inside.end()) {
    throw InputError("mesh", fmt::format("vertex {} is not inside of the cage", first - inside.begin()),
                     "give a cage that encloses the mesh, as partwise cage makes it");
  }
}

Vertices CageDeformer::deformed(const Vertices& cage_vertices) const {
  if (cage_vertices.rows() != cage_.vertices.rows()) {
    throw InputError("cage", fmt::format("{} vertices are given for {}", cage_vertices.rows(), cage_.vertices.rows()),
                     "keep the number of vertices");
  }
  Vertices result = vertex_weights_ * cage_vertices;
  if (face_weights_.cols() == 0) return result;
  Vertices normals(cage_.faces.rows(), 3);
  for (Eigen::Index f = 0; f < cage_.faces.rows(); ++f) {
    const auto face = cage_.faces.row(f);
    const auto side = [&](const Vertices& at, int k) -> Point { return at.row(face[k]) - at.row(face[0]); };
    const Point u = side(cage_.vertices, 1), v = side(cage_.vertices, 2), u_now = side(cage_vertices, 1),
                v_now = side(cage_vertices, 2);
    const Point across = u_now.cross(v_now);
    // A face that collapsed has no side left to push from.
    normals.row(f) = across.norm() > 0 ? Point(stretch(u, v, u_now, v_now) * across.normalized()) : Point::Zero();
  }
  result += face_weights_ * normals;
  return result;
}

}  // namespace partwise
