// Depths of simple things, exact but for their single precision. Tests only; not installed.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "partwise/imaging/image.h"
#include "partwise/normals/truth/pinhole_camera.h"

namespace partwise::test {

inline constexpr PinholeCamera small_camera{120, 130, 47.25, 35.5};  // of 96 x 72 pixels
inline constexpr int small_width = 96, small_height = 72;

// depth(ray) of every pixel.
template <typename Depth>
Image depth_picture(const PinholeCamera& camera, int width, int height, const Depth& depth) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.pixel(x, y)[0] = static_cast<float>(depth(camera.ray(x, y)));
  }
  return image;
}

// The plane through (0, 0, -distance) with this normal; behind the camera, nothing.
struct PlaneDepth {
  Eigen::Vector3d normal;
  double distance = 1;
  double operator()(const Eigen::Vector3d& ray) const {
    const double depth = -distance * normal.z() / normal.dot(ray);
    return depth > 0 ? depth : 0;
  }
};

// The near side of a sphere with its centre at (0, 0, -distance).
struct SphereDepth {
  double distance = 2, radius = 0.5;
  double operator()(const Eigen::Vector3d& ray) const {
    const double a = ray.squaredNorm(), c = distance * distance - radius * radius;
    const double square = distance * distance - a * c;
    return square > 0 ? (distance - std::sqrt(square)) / a : 0;
  }
};

// Slanted by this angle, towards this direction of the picture (0: it faces right, 90: up).
inline Eigen::Vector3d slanted(double degrees, double towards_degrees) {
  const double slant = degrees * std::numbers::pi / 180, towards = towards_degrees * std::numbers::pi / 180;
  return {std::sin(slant) * std::cos(towards), std::sin(slant) * std::sin(towards), std::cos(slant)};
}

inline Eigen::Vector3d normal_at(const Image& normals, int x, int y) {
  return Eigen::Map<const Eigen::Vector3f>(normals.pixel(x, y)).cast<double>();
}

inline double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

}  // namespace partwise::test
