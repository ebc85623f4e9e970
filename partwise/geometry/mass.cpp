#include "partwise/geometry/mass.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Volume, centre and second moments (the integral of x x^T) about the centre.
struct Moments {
  double volume = 0;
  Point centre = Point::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

// The volume is zero when it cannot be told from rounding.
Moments moments(const Mesh& mesh) {
  Moments result;
  if (mesh.faces.rows() == 0) return result;
  Point low = mesh.vertices.row(mesh.faces(0, 0)), high = low;  // Vertices that no face uses may lie anywhere.
  for (const int v : mesh.faces.reshaped()) {
    low = low.cwiseMin(mesh.vertices.row(v));
    high = high.cwiseMax(mesh.vertices.row(v));
  }
  const Point origin = (low + high) / 2;
  double six_volumes = 0;
  Point first = Point::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& f : mesh.faces.rowwise()) {
    const Point a = mesh.vertices.row(f[0]) - origin, b = mesh.vertices.row(f[1]) - origin,
                c = mesh.vertices.row(f[2]) - origin;
    const double six = a.dot(b.cross(c));  // of the tetrahedron (origin, a, b, c)
    const Point sum = a + b + c;
    six_volumes += six;
    first += six / 24 * sum;
    second += six / 120 * (a.transpose() * a + b.transpose() * b + c.transpose() * c + sum.transpose() * sum);
  }
  const double volume = six_volumes / 6;
  if (!(std::abs(volume) > 1e-12 * std::pow((high - low).norm(), 3))) return result;
  const Point centre = first / volume;
  result.volume = std::abs(volume);
  result.centre = origin + centre;
  result.second = (second - volume * centre.transpose() * centre) * (volume < 0 ? -1 : 1);
  return result;
}

MassProperties to_properties(const Moments& m) {
  if (m.volume == 0) throw InputError("mesh", "encloses no volume", "give a closed mesh that is not flat");
  return {m.volume, m.centre, m.second.trace() * Eigen::Matrix3d::Identity() - m.second};
}

}  // namespace

MassProperties mass_properties(const Mesh& mesh) { return to_properties(moments(mesh)); }

MassProperties mass_properties(std::span<const Mesh> meshes) {
  std::vector<Moments> each;
  Moments sum;
  for (const Mesh& mesh : meshes) {
    each.push_back(moments(mesh));
    if (each.back().volume == 0) {
      each.pop_back();
      continue;
    }
    sum.volume += each.back().volume;
    // A running mean, so that a far set of bodies loses no digits.
    sum.centre += (each.back().centre - sum.centre) * (each.back().volume / sum.volume);
  }
  for (const Moments& m : each) {  // Steiner's theorem
    const Point offset = m.centre - sum.centre;
    sum.second += m.second + m.volume * offset.transpose() * offset;
  }
  return to_properties(sum);
}

bool is_physical(const MassProperties& properties) {
  if (!(properties.volume > 0) || !properties.inertia.allFinite()) return false;
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(properties.inertia, Eigen::EigenvaluesOnly).eigenvalues();
  return principal[0] > 0 && principal[2] <= (principal[0] + principal[1]) * (1 + 1e-9);
}

}  // namespace partwise
