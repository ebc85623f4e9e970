#include "partwise/editing/picture_terms.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <cmath>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/base/error.h"

namespace partwise {

at::Tensor display_values(const at::Tensor& linear) {
  constexpr double gamma = 2.2;
  constexpr double darkest = 1e-4;  // the slope at zero is finite
  const double lift = std::pow(darkest, 1 / gamma);
  const at::Tensor positive = linear.clamp_min(0);
  const at::Tensor curve = ((positive + darkest).pow(1 / gamma) - lift) / (std::pow(1 + darkest, 1 / gamma) - lift);
  return at::where(positive <= 1, curve, 1 + 0.1 * positive.clamp_min(1).log());
}

at::Tensor row_weights(std::int64_t rows) {
  at::Tensor weights = at::empty({1, 1, rows, 1});
  for (std::int64_t y = 0; y < rows; ++y) {
    weights.data_ptr<float>()[y] =
        static_cast<float>(equirectangular_solid_angle(static_cast<int>(y), 1, static_cast<int>(rows)));
  }
  return weights / weights.mean();
}

at::Tensor object_mean(const at::Tensor& values, const at::Tensor& mask) {
  const at::Tensor sums = (values * mask).mean(1).sum({1, 2});
  return sums / mask.sum({1, 2, 3}).clamp_min(1);
}

at::Tensor exposed_as(const at::Tensor& images, const at::Tensor& truths, const at::Tensor& mask) {
  constexpr double dark = 0.01;
  const at::Tensor stops = object_mean(((truths + dark) / (images.clamp_min(0) + dark)).log(), mask);
  return images * stops.exp().reshape({-1, 1, 1, 1});
}

at::Tensor reduced_perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b,
                                       int side) {
  if (a.size(3) == side) return perceptual_distance(features, a, b);
  return perceptual_distance(features, at::adaptive_avg_pool2d(a, {side, side}),
                             at::adaptive_avg_pool2d(b, {side, side}));
}

at::Tensor reduced_light(const at::Tensor& radiance, int columns) {
  const std::int64_t rows = radiance.size(2), step = radiance.size(3) / columns;
  if (step == 1) return radiance;
  PARTWISE_CHECK(radiance.size(3) % columns, ==, 0);
  PARTWISE_CHECK(rows % step, ==, 0);
  const at::Tensor weights = row_weights(rows).to(radiance.scalar_type());
  return at::avg_pool2d(radiance * weights, {step, step}) / at::avg_pool2d(weights, {step, 1});
}

}  // namespace partwise
