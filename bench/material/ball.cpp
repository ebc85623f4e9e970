#include "bench/material/ball.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "partwise/imaging/image_io.h"

namespace partwise::bench {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3f direction(int x, int y) {
  const double t = kPi * (y + 0.5) / SmallLight::height, p = 2 * kPi * ((x + 0.5) / SmallLight::width - 0.5);
  return Eigen::Vector3d(std::sin(t) * std::sin(p), std::cos(t), -std::sin(t) * std::cos(p)).cast<float>();
}

std::optional<Eigen::Vector3f> normal(int x, int y) {
  const float a = 2 * (static_cast<float>(x) + 0.5f) / ball_size - 1,
              b = 1 - 2 * (static_cast<float>(y) + 0.5f) / ball_size;
  const float rest = 1 - a * a - b * b;
  if (rest <= 0) return {};
  return Eigen::Vector3f(a, b, std::sqrt(rest));
}

}  // namespace

SmallLight small_light(const std::string& file) {
  const Image image = read_image(file);
  SmallLight light;
  for (int y = 0; y < SmallLight::height; ++y) {
    for (int x = 0; x < SmallLight::width; ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int row = y * image.height / SmallLight::height; row < (y + 1) * image.height / SmallLight::height; ++row) {
        const double band = std::cos(kPi * row / image.height) - std::cos(kPi * (row + 1) / image.height);
        for (int column = x * image.width / SmallLight::width; column < (x + 1) * image.width / SmallLight::width;
             ++column) {
          const float* pixel = image.pixel(column, row);
          sum += Eigen::Vector3f(pixel[0], pixel[1], pixel[2]).cwiseMax(0.0f).cast<double>() * band * 2 * kPi /
                 image.width;
        }
      }
      light.radiance.push_back(sum.cast<float>());
    }
  }
  return light;
}

std::vector<Image> balls(const Brdf& material, const std::vector<SmallLight>& lights) {
  std::vector<Image> images(lights.size(), Image(ball_size, ball_size, 3));
  tbb::parallel_for(0, ball_size, [&](int y) {
    for (int x = 0; x < ball_size; ++x) {
      const auto n = normal(x, y);
      if (!n) continue;
      const Eigen::Matrix3f local = Eigen::Quaternionf::FromTwoVectors(*n, Eigen::Vector3f::UnitZ()).toRotationMatrix();
      const Eigen::Vector3f to_viewer = local.col(2);
      std::vector<Eigen::Vector3d> sums(lights.size(), Eigen::Vector3d::Zero());
      for (std::size_t i = 0; i < SmallLight::width * SmallLight::height; ++i) {
        const Eigen::Vector3f light =
            direction(static_cast<int>(i) % SmallLight::width, static_cast<int>(i) / SmallLight::width);
        const float cosine = n->dot(light);
        if (cosine <= 0) continue;
        const Eigen::Vector3f value = material(local * light, to_viewer) * cosine;
        for (std::size_t k = 0; k < lights.size(); ++k)
          sums[k] += value.cwiseProduct(lights[k].radiance[i]).cast<double>();
      }
      for (std::size_t k = 0; k < lights.size(); ++k) {
        for (int channel = 0; channel < 3; ++channel)
          images[k].pixel(x, y)[channel] = static_cast<float>(sums[k][channel]);
      }
    }
  });
  return images;
}

Mask ball_mask() {
  Mask mask(ball_size, ball_size, 1);
  for (int y = 0; y < ball_size; ++y) {
    for (int x = 0; x < ball_size; ++x) *mask.pixel(x, y) = normal(x, y) ? 1.0f : 0.0f;
  }
  return mask;
}

}  // namespace partwise::bench
