#include "partwise/learning/light_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

template <typename Scalar>
Scalar bounded_exp(Scalar value) {
  return std::exp(std::clamp(value, Scalar(-largest_log_gamma), Scalar(largest_log_gamma)));
}

}  // namespace

template <typename Scalar>
std::vector<LightPixel<Scalar>> light_grid(int height, int width) {
  PARTWISE_CHECK(height, >=, 1);
  PARTWISE_CHECK(width, >=, 1);
  std::vector<LightPixel<Scalar>> grid;
  grid.reserve(static_cast<std::size_t>(height) * static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3d direction = equirectangular_direction(x, y, width, height);
      const Eigen::Vector3d half = half_vector(direction);
      const SplineWeights weights = spline_weights(std::acos(std::clamp(half.z(), 0.0, 1.0)));
      LightPixel<Scalar> pixel;
      for (std::size_t k = 0; k < 3; ++k) {
        pixel.direction[k] = static_cast<Scalar>(direction[static_cast<Eigen::Index>(k)]);
        pixel.half_vector[k] = static_cast<Scalar>(half[static_cast<Eigen::Index>(k)]);
      }
      for (int k = 0; k < spline_size; ++k) pixel.basis[static_cast<std::size_t>(k)] = static_cast<Scalar>(weights[k]);
      pixel.solid_angle = static_cast<Scalar>(equirectangular_solid_angle(y, width, height));
      grid.push_back(pixel);
    }
  }
  return grid;
}

template <typename Scalar>
std::vector<PixelLobes<Scalar>> pixel_lobes(const std::vector<LightPixel<Scalar>>& grid,
                                            const Coefficients<Scalar>& material) {
  std::vector<PixelLobes<Scalar>> result(grid.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Eigen::Map<const Eigen::Array<Scalar, spline_size, 1>> basis(grid[i].basis.data());
      const auto curve = [&](int lobe, DsbrdfCurve which) {
        return (material.template segment<spline_size>(curve_at(lobe, which)) * basis).sum();
      };
      for (int lobe = 0; lobe < lobe_total; ++lobe) {
        const auto at = static_cast<std::size_t>(lobe);
        const Scalar gamma = curve(lobe, DsbrdfCurve::gamma);
        result[i].log_kappa[at] = curve(lobe, DsbrdfCurve::kappa);
        result[i].gamma[at] = signed_gamma(lobe) ? gamma : bounded_exp(gamma);
      }
    }
  });
  return result;
}

template <typename Scalar>
Coefficients<Scalar> coefficient_gradient(const std::vector<LightPixel<Scalar>>& grid,
                                          const std::vector<PixelLobes<Scalar>>& lobes,
                                          const std::vector<PixelLobes<Scalar>>& lobe_gradient) {
  Coefficients<double> sum = Coefficients<double>::Zero();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto basis =
        Eigen::Map<const Eigen::Array<Scalar, spline_size, 1>>(grid[i].basis.data()).template cast<double>().eval();
    for (int lobe = 0; lobe < lobe_total; ++lobe) {
      const auto at = static_cast<std::size_t>(lobe);
      const double kappa = static_cast<double>(lobe_gradient[i].log_kappa[at]);
      const double gamma = static_cast<double>(lobe_gradient[i].gamma[at]) *
                           (signed_gamma(lobe) ? 1 : static_cast<double>(lobes[i].gamma[at]));
      sum.segment<spline_size>(curve_at(lobe, DsbrdfCurve::kappa)) += kappa * basis;
      sum.segment<spline_size>(curve_at(lobe, DsbrdfCurve::gamma)) += gamma * basis;
    }
  }
  return sum.cast<Scalar>();
}

template std::vector<LightPixel<float>> light_grid(int, int);
template std::vector<PixelLobes<float>> pixel_lobes(const std::vector<LightPixel<float>>&, const Coefficients<float>&);
template Coefficients<float> coefficient_gradient(const std::vector<LightPixel<float>>&,
                                                  const std::vector<PixelLobes<float>>&,
                                                  const std::vector<PixelLobes<float>>&);
template std::vector<LightPixel<double>> light_grid(int, int);
template std::vector<PixelLobes<double>> pixel_lobes(const std::vector<LightPixel<double>>&,
                                                     const Coefficients<double>&);
template Coefficients<double> coefficient_gradient(const std::vector<LightPixel<double>>&,
                                                   const std::vector<PixelLobes<double>>&,
                                                   const std::vector<PixelLobes<double>>&);

}  // namespace partwise
