// The equal-area disk of normals that reflectance maps are stored in, and where a lookup in it falls.
//
// The texel at p, x to the right and y up, stands for the normal with p = (x, y) / sqrt(1 + z). The rim, z = 0, lies
// one texel inside the sides of the square map; rows run from +y down. Lookups are bicubic (Catmull and Rom 1974).
// `Scalar` is float or double. Errors: none; sizes are at least 8.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace partwise {

// All texels that lookups reach. Beyond the rim the disk's formula goes on to the other side of the sphere.
struct DiskTexels {
  std::vector<int> index;  // into the map, row by row
  std::vector<Eigen::Vector3d> normals;
};
DiskTexels disk_texels(int size);

inline constexpr int disk_margin = 1;                                      // texels beyond the rim on the axes
constexpr int disk_steps(int size) { return size - 1 - 2 * disk_margin; }  // texels from rim to rim
inline constexpr float disk_least_z = -0.5f;                               // normals beyond count as turned this far

// Catmull and Rom's spline between the second and third of four values, and the derivatives of its weights.
template <typename Scalar>
std::array<Scalar, 4> cubic_weights(Scalar t) {
  return {((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2, (t - 1) * t * t / 2};
}
template <typename Scalar>
std::array<Scalar, 4> cubic_slopes(Scalar t) {
  return {((4 - 3 * t) * t - 1) / 2, (9 * t - 10) * t / 2, ((8 - 9 * t) * t + 1) / 2, (3 * t - 2) * t / 2};
}

// Of a unit normal: its point in the disk; one that turns away from the viewer counts as the rim beside it.
template <typename Scalar>
Eigen::Matrix<Scalar, 2, 1> disk_point(const Eigen::Matrix<Scalar, 3, 1>& normal) {
  Eigen::Matrix<Scalar, 2, 1> point =
      normal.template head<2>() / std::sqrt(1 + std::max(normal.z(), Scalar(disk_least_z)));
  point /= std::max(point.norm(), Scalar(1));
  return point;
}

// Its derivatives: row i is that of coordinate i to the normal.
template <typename Scalar>
Eigen::Matrix<Scalar, 2, 3> disk_point_slopes(const Eigen::Matrix<Scalar, 3, 1>& normal) {
  const Scalar square = 1 + std::max(normal.z(), Scalar(disk_least_z)), scale = 1 / std::sqrt(square);
  const Eigen::Matrix<Scalar, 2, 1> point = scale * normal.template head<2>();
  Eigen::Matrix<Scalar, 2, 3> slopes = Eigen::Matrix<Scalar, 2, 3>::Zero();
  slopes(0, 0) = slopes(1, 1) = scale;
  if (normal.z() > Scalar(disk_least_z)) slopes.col(2) = -point / (2 * square);
  const Scalar length = point.norm();
  if (length > 1) {  // onto the rim: only what runs along it is left
    const Eigen::Matrix<Scalar, 2, 1> out = point / length;
    slopes = (slopes - out * (out.transpose() * slopes)).eval() / length;
  }
  return slopes;
}

// The 4 x 4 texels that a lookup joins, from column x - 1 and row y - 1 on, and how far beyond (x, y) it falls.
template <typename Scalar>
struct DiskPlace {
  int x, y;
  Scalar right, below;

  DiskPlace(const Eigen::Matrix<Scalar, 2, 1>& point, int size) {
    const auto radius = static_cast<Scalar>(disk_steps(size)) / 2;
    const Scalar across = disk_margin + (1 + point.x()) * radius, down = disk_margin + (1 - point.y()) * radius;
    x = std::clamp(static_cast<int>(across), 1, size - 3);
    y = std::clamp(static_cast<int>(down), 1, size - 3);
    right = across - static_cast<Scalar>(x);
    below = down - static_cast<Scalar>(y);
  }
};

}  // namespace partwise
