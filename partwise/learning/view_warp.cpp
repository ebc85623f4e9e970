#include "partwise/learning/view_warp.h"

#include <ATen/Functions.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstdint>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// The places of a view's pixels: (0, 0) is the middle, one unit a pixel.
class Pixels {
 public:
  explicit Pixels(std::int64_t side) : side_(side), half_(0.5 * static_cast<double>(side - 1)) {}

  std::int64_t side() const { return side_; }
  Eigen::Vector2d place(std::int64_t row, std::int64_t column) const {
    return {static_cast<double>(column) - half_, half_ - static_cast<double>(row)};
  }
  // work(index, weight) for those of the four pixels about a place that lie in the view.
  template <typename Work>
  void about(const Eigen::Vector2d& place, const Work& work) const {
    const double x = place.x() + half_, y = half_ - place.y();
    const double left = std::floor(x), above = std::floor(y);
    for (int i = 0; i < 4; ++i) {
      const std::int64_t row = static_cast<std::int64_t>(above) + i / 2;
      const std::int64_t column = static_cast<std::int64_t>(left) + i % 2;
      if (row < 0 || column < 0 || row >= side_ || column >= side_) continue;
      work(row * side_ + column, (i % 2 == 0 ? left + 1 - x : x - left) * (i < 2 ? above + 1 - y : y - above));
    }
  }

 private:
  std::int64_t side_;
  double half_;
};

// Where in the old view pixels of the new one come from. is_object(index): of a pixel of the old one.
class Origin {
 public:
  template <typename IsObject>
  Origin(const Pixels& pixels, const ViewWarp& warp, const IsObject& is_object) : pixels_(pixels) {
    PARTWISE_CHECK(std::abs(warp.plane.determinant()), >, 0);
    PARTWISE_CHECK(warp.share, >, 0);
    back_ = warp.plane.inverse();
    for (std::int64_t row = 0; row < pixels.side(); ++row) {
      for (std::int64_t column = 0; column < pixels.side(); ++column) {
        if (!is_object(row * pixels.side() + column)) continue;
        for (const auto& corner : {Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(0.5, -0.5)}) {
          const Eigen::Vector2d reach = (warp.plane * corner).cwiseAbs(),
                                middle = warp.plane * pixels.place(row, column);
          box_.extend(middle + reach).extend(middle - reach);
        }
      }
    }
    if (!is_empty()) scale_ = warp.share * static_cast<double>(pixels.side()) / box_.sizes().maxCoeff();
  }

  bool is_empty() const { return box_.isEmpty(); }
  const Eigen::Matrix2d& back() const { return back_; }
  Eigen::Vector2d of(std::int64_t row, std::int64_t column) const {
    return back_ * (pixels_.place(row, column) / scale_ + box_.center());
  }

 private:
  const Pixels& pixels_;
  Eigen::AlignedBox2d box_;  // of the object, in the new view before it is scaled
  Eigen::Matrix2d back_;
  double scale_ = 1;
};

}  // namespace

at::Tensor warped_normals(const at::Tensor& normals, const ViewWarp& warp) {
  PARTWISE_CHECK(normals.dim(), ==, 3);
  PARTWISE_CHECK(normals.size(0), ==, 3);
  PARTWISE_CHECK(normals.size(1), ==, normals.size(2));
  PARTWISE_CHECK(warp.depth, >, 0);
  const at::Tensor source = normals.contiguous();
  const Pixels pixels(normals.size(1));
  const std::int64_t side = pixels.side(), plane = side * side;
  const float* from = source.data_ptr<float>();
  const auto at = [&](std::int64_t i) { return Eigen::Vector3d(from[i], from[i + plane], from[i + 2 * plane]); };
  const Origin origin(pixels, warp, [&](std::int64_t i) { return !at(i).isZero(); });
  if (origin.is_empty()) return normals;

  at::Tensor result = at::zeros_like(source);
  float* values = result.data_ptr<float>();
  for (std::int64_t row = 0; row < side; ++row) {
    for (std::int64_t column = 0; column < side; ++column, ++values) {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      double object = 0;
      pixels.about(origin.of(row, column), [&](std::int64_t i, double weight) {
        normal += weight * at(i);
        if (!at(i).isZero()) object += weight;
      });
      if (object <= 0.5 || normal.isZero()) continue;
      Eigen::Vector3d turned;
      turned.z() = normal.z() / warp.depth;
      turned.head<2>() = origin.back().transpose() * (normal.head<2>() - turned.z() * warp.lean);
      turned.normalize();
      for (int i = 0; i < 3; ++i) values[i * plane] = static_cast<float>(turned[i]);
    }
  }
  return result;
}

at::Tensor warped_parts(const at::Tensor& parts, const ViewWarp& warp) {
  PARTWISE_CHECK(parts.dim(), ==, 2);
  PARTWISE_CHECK(parts.size(0), ==, parts.size(1));
  const at::Tensor source = parts.contiguous();
  const Pixels pixels(parts.size(0));
  const std::uint8_t* from = source.data_ptr<std::uint8_t>();
  const Origin origin(pixels, warp, [&](std::int64_t i) { return from[i] != 0; });
  if (origin.is_empty()) return parts;

  at::Tensor result = at::zeros_like(source);
  std::uint8_t* value = result.data_ptr<std::uint8_t>();
  for (std::int64_t row = 0; row < pixels.side(); ++row) {
    for (std::int64_t column = 0; column < pixels.side(); ++column, ++value) {
      double object = 0, largest = 0;
      std::uint8_t part = 0;
      pixels.about(origin.of(row, column), [&](std::int64_t i, double weight) {
        if (from[i] == 0) return;
        object += weight;
        if (weight > largest) largest = weight, part = from[i];
      });
      if (object > 0.5) *value = part;
    }
  }
  return result;
}

}  // namespace partwise
