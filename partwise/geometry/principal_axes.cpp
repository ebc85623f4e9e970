#include "partwise/geometry/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <numeric>
#include <vector>

namespace partwise {
namespace {

using Corners = Eigen::Matrix3d;  // a face's vertices, one a row

Corners corners_of(const Mesh& mesh, Eigen::Index face) { return mesh.vertices(mesh.faces.row(face), Eigen::all); }

// The integral of x y^T over a face of area 1.
Eigen::Matrix3d second_moment(const Corners& c) {
  const Point sum = c.colwise().sum();
  return (c.transpose() * c + sum.transpose() * sum) / 12;
}

// The integral over a face of area 1 of the cube of a linear function with these values at the corners.
double third_moment(const Eigen::Vector3d& at) {
  const double sum = at.sum(), squares = at.squaredNorm(), cubes = at.array().cube().sum();
  return (sum * sum * sum + 3 * sum * squares + 2 * cubes) / 60;
}

}  // namespace

SurfaceMoments surface_moments(const Mesh& mesh) {
  const std::vector<double> areas = face_areas(mesh);
  SurfaceMoments result;
  result.area = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(result.area > 0) || !std::isfinite(result.area)) return result;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    result.centroid += areas[f] / result.area * corners_of(mesh, f).colwise().mean();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Corners c = corners_of(mesh, f);
    result.second += areas[f] / result.area * second_moment(c.rowwise() - result.centroid);
  }
  return result;
}

Eigen::Matrix3d principal_axes(const Mesh& mesh) {
  constexpr double kUpright = 1e-12, kSkew = 1e-9;
  const std::vector<double> areas = face_areas(mesh);
  auto [area, centroid, moments] = surface_moments(mesh);
  if (!(area > 0) || !std::isfinite(area)) return Eigen::Matrix3d::Identity();
  moments = (moments.array().abs() < kUpright * moments.trace()).select(0, moments);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  const double spread = std::sqrt(moments.trace());
  for (int k = 0; k < 2; ++k) {
    double skew = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      const Corners c = corners_of(mesh, f);
      skew += areas[f] / area * third_moment((c.rowwise() - centroid) * axes.row(k).transpose());
    }
    Eigen::Index largest;
    axes.row(k).cwiseAbs().maxCoeff(&largest);
    const bool symmetric = std::abs(skew) <= kSkew * spread * spread * spread;
    if (symmetric ? axes(k, largest) < 0 : skew < 0) axes.row(k) *= -1;
  }
  axes.row(2) = axes.row(0).cross(axes.row(1));
  const Eigen::Matrix3d rounded = axes.array().round();
  if ((axes - rounded).cwiseAbs().maxCoeff() <= kUpright) axes = rounded;
  return axes;
}

}  // namespace partwise
