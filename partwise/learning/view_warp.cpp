#include "partwise/learning/view_warp.h"

#include <ATen/Functions.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// A view with the places of its pixels: (0, 0) is the middle, one unit a pixel.
class Pixels {
 public:
  explicit Pixels(const at::Tensor& normals)
      : values_(normals.data_ptr<float>()), side_(normals.size(1)), half_(0.5 * static_cast<double>(side_ - 1)) {}

  std::int64_t side() const { return side_; }
  Eigen::Vector2d place(std::int64_t row, std::int64_t column) const {
    return {static_cast<double>(column) - half_, half_ - static_cast<double>(row)};
  }
  Eigen::Vector3d at(std::int64_t row, std::int64_t column) const {
    if (row < 0 || column < 0 || row >= side_ || column >= side_) return Eigen::Vector3d::Zero();
    const float* value = values_ + row * side_ + column;
    const std::int64_t plane = side_ * side_;
    return {value[0], value[plane], value[2 * plane]};
  }
  // Zero where half of the weights or less are object.
  Eigen::Vector3d between(const Eigen::Vector2d& place) const {
    const double x = place.x() + half_, y = half_ - place.y();
    const double left = std::floor(x), above = std::floor(y);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double object = 0;
    for (int i = 0; i < 4; ++i) {
      const double weight = (i % 2 == 0 ? left + 1 - x : x - left) * (i < 2 ? above + 1 - y : y - above);
      const Eigen::Vector3d normal =
          at(static_cast<std::int64_t>(above) + i / 2, static_cast<std::int64_t>(left) + i % 2);
      if (normal.isZero()) continue;
      sum += weight * normal;
      object += weight;
    }
    return object > 0.5 ? sum : Eigen::Vector3d::Zero();
  }

 private:
  const float* values_;
  std::int64_t side_;
  double half_;
};

Eigen::AlignedBox2d box_of_object(const Pixels& pixels, const Eigen::Matrix2d& plane) {
  Eigen::AlignedBox2d box;
  for (std::int64_t row = 0; row < pixels.side(); ++row) {
    for (std::int64_t column = 0; column < pixels.side(); ++column) {
      if (pixels.at(row, column).isZero()) continue;
      for (const auto& corner : {Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(0.5, -0.5)}) {
        const Eigen::Vector2d reach = (plane * corner).cwiseAbs(), middle = plane * pixels.place(row, column);
        box.extend(middle + reach).extend(middle - reach);
      }
    }
  }
  return box;
}

}  // namespace

at::Tensor warped_normals(const at::Tensor& normals, const ViewWarp& warp) {
  PARTWISE_CHECK(normals.dim(), ==, 3);
  PARTWISE_CHECK(normals.size(0), ==, 3);
  PARTWISE_CHECK(normals.size(1), ==, normals.size(2));
  PARTWISE_CHECK(std::abs(warp.plane.determinant()), >, 0);
  PARTWISE_CHECK(warp.depth, >, 0);
  PARTWISE_CHECK(warp.share, >, 0);
  const at::Tensor source = normals.contiguous();
  const Pixels pixels(source);
  const Eigen::AlignedBox2d box = box_of_object(pixels, warp.plane);
  if (box.isEmpty()) return normals;
  const double scale = warp.share * static_cast<double>(pixels.side()) / box.sizes().maxCoeff();
  const Eigen::Matrix2d back = warp.plane.inverse();

  at::Tensor result = at::zeros_like(source);
  float* values = result.data_ptr<float>();
  const std::int64_t plane = pixels.side() * pixels.side();
  for (std::int64_t row = 0; row < pixels.side(); ++row) {
    for (std::int64_t column = 0; column < pixels.side(); ++column, ++values) {
      const Eigen::Vector3d normal = pixels.between(back * (pixels.place(row, column) / scale + box.center()));
      if (normal.isZero()) continue;
      Eigen::Vector3d turned;
      turned.z() = normal.z() / warp.depth;
      turned.head<2>() = back.transpose() * (normal.head<2>() - turned.z() * warp.lean);
      turned.normalize();
      for (int i = 0; i < 3; ++i) values[i * plane] = static_cast<float>(turned[i]);
    }
  }
  return result;
}

}  // namespace partwise
