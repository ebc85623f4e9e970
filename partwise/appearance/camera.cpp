#include "partwise/appearance/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Over all points p with radius r: the largest of +-p_k / cos(half angle) + slope z, with the sphere's r added, that is
// how far out the four side planes of the view have to stand.
struct Extent {
  double slope, positive = -std::numeric_limits<double>::infinity(), negative = positive;
  explicit Extent(double slope_) : slope(slope_) {}
  void add(double across, double back, double radius) {
    const double reach = radius * std::sqrt(1 + slope * slope);
    positive = std::max(positive, across + slope * back + reach);
    negative = std::max(negative, -across + slope * back + reach);
  }
  double centre() const { return (positive - negative) / 2; }
  double half() const { return (positive + negative) / 2; }
};

}  // namespace

Camera frame_points(std::span<const RoundPoints> bodies, const CameraView& view, double width_over_height) {
  PARTWISE_CHECK(width_over_height, >, 0);
  PARTWISE_CHECK(view.fill, >, 0);
  PARTWISE_CHECK(view.fill, <=, 1);
  PARTWISE_CHECK(view.field_of_view, >=, 0);
  PARTWISE_CHECK(view.field_of_view, <, 180);
  constexpr double radians = std::numbers::pi / 180;
  Camera camera;
  camera.axes = (Eigen::AngleAxisd(view.azimuth * radians, Eigen::Vector3d::UnitY()) *
                 Eigen::AngleAxisd(-view.elevation * radians, Eigen::Vector3d::UnitX()))
                    .toRotationMatrix()
                    .transpose();
  camera.orthographic = view.field_of_view == 0;
  const double tangent = std::tan(view.field_of_view * radians / 2);  // 0 when orthographic
  Extent across(tangent * width_over_height * view.fill), up(tangent * view.fill);
  double nearest = -std::numeric_limits<double>::infinity();
  for (const auto& [points, radius] : bodies) {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      const Eigen::Vector3d p = camera.axes * points->row(i).transpose();
      across.add(p.x(), p.z(), radius);
      up.add(p.y(), p.z(), radius);
      nearest = std::max(nearest, p.z() + radius);
    }
  }
  PARTWISE_CHECK(std::isfinite(nearest), ==, true);

  double back = 0;
  if (camera.orthographic) {
    camera.half_height = std::max(up.half(), across.half() / width_over_height) / view.fill;
    back = nearest + camera.half_height;
  } else {
    camera.half_height = tangent;
    back = std::max(up.half() / up.slope, across.half() / across.slope);
  }
  camera.position = (camera.axes.transpose() * Eigen::Vector3d(across.centre(), up.centre(), back)).transpose();
  return camera;
}

}  // namespace partwise
