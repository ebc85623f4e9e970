// What the sum (3.2) needs of an equirectangular light of a given size and of a material, before any normal is known:
// with the constant view +z, a light pixel's direction fixes its half-vector and so theta_d, and with it the nine lobes
// of a Dsbrdf. Axes, solid angles and half-vectors are those of appearance/rendering. `Scalar` is float or double.
// Errors: CheckFailed for sizes below 1.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"

namespace partwise {

template <typename Scalar>
struct LightPixel {
  std::array<Scalar, 3> direction, half_vector;
  Scalar solid_angle;
  std::array<Scalar, spline_size> basis;  // of the splines at its theta_d
};

// Row by row, as the light's pixels.
template <typename Scalar>
std::vector<LightPixel<Scalar>> light_grid(int height, int width);

// Where a curve's six coefficients begin in a material, and whether a lobe's gamma is its curve as it stands.
constexpr int curve_at(int lobe, DsbrdfCurve which) {
  return lobe / dsbrdf_lobe_count * dsbrdf_channel_size + curve_offset(lobe % dsbrdf_lobe_count, which);
}
constexpr bool signed_gamma(int lobe) { return lobe % dsbrdf_lobe_count == 0; }

// Curves beyond any that a material has are cut here, so that floats stay finite, and with them every product of
// theirs.
inline constexpr int largest_log_gamma = 40;

inline constexpr int lobe_total = 3 * dsbrdf_lobe_count;  // lobe r of channel c is number 3 c + r

// The lobes at one light pixel, exp(log_kappa + gamma log(n.h)) the exponent of each.
template <typename Scalar>
struct PixelLobes {
  std::array<Scalar, lobe_total> log_kappa, gamma;
};

template <typename Scalar>
using Coefficients = Eigen::Array<Scalar, dsbrdf_size, 1>;

template <typename Scalar>
std::vector<PixelLobes<Scalar>> pixel_lobes(const std::vector<LightPixel<Scalar>>& grid,
                                            const Coefficients<Scalar>& material);

// The other way: from derivatives to the lobes of every pixel to those to the coefficients.
template <typename Scalar>
Coefficients<Scalar> coefficient_gradient(const std::vector<LightPixel<Scalar>>& grid,
                                          const std::vector<PixelLobes<Scalar>>& lobes,
                                          const std::vector<PixelLobes<Scalar>>& lobe_gradient);

}  // namespace partwise
