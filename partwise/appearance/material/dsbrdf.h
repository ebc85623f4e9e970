// Directional statistics BRDF: each channel is the sum of three lobes about the half-vector,
//
//   f_c(theta_h, theta_d) = sum over r of expm1( kappa_cr(theta_d) * cos(theta_h)^gamma_cr(theta_d) ),
//
// where kappa sets a lobe's strength and gamma its sharpness (Nishino 2009, "Directional statistics BRDF model";
// Nishino and Lombardi 2011; dissertation, section 3.3.1). Both are smooth curves over theta_d, the angle between light
// and half-vector: cubic B-splines with the clamped knots 0, pi/6, pi/3, pi/2, six coefficients each. 3 channels x 3
// lobes x 2 curves x 6 coefficients = 108 numbers describe a material.
//
// kappa is the exponential of its spline. So is gamma, except in the first, broadest lobe, whose gamma is its spline as
// it stands: a negative one makes the lobe rise towards grazing half-vectors, as cloth and felt do. Reciprocal by
// construction; nothing makes it conserve energy.
//
// Angles in radians, values linear RGB in 1/sr. Errors: none; finite coefficients give finite values.
#pragma once

#include <Eigen/Core>

#include "partwise/appearance/material/brdf.h"

namespace partwise {

inline constexpr int dsbrdf_lobe_count = 3;
inline constexpr int spline_size = 6;                                            // coefficients a curve
inline constexpr int dsbrdf_channel_size = dsbrdf_lobe_count * 2 * spline_size;  // coefficients a channel, 36
inline constexpr int dsbrdf_size = 3 * dsbrdf_channel_size;                      // 108

using SplineWeights = Eigen::Matrix<double, spline_size, 1>;
using DsbrdfChannel = Eigen::Matrix<double, dsbrdf_channel_size, 1>;
using DsbrdfCoefficients = Eigen::Matrix<double, dsbrdf_size, 1>;

// Values at theta_d of the six basis functions; angles outside [0, pi/2] are moved to its ends. They are not negative
// and sum to 1, so that a curve stays within the range of its coefficients.
SplineWeights spline_weights(double theta_d);

enum class DsbrdfCurve { kappa, gamma };

// Where a curve's six coefficients begin among the 36 of a channel; channel c of a material begins at 36 c.
constexpr int curve_offset(int lobe, DsbrdfCurve curve) {
  return (2 * lobe + (curve == DsbrdfCurve::gamma ? 1 : 0)) * spline_size;
}

// cos(theta_h) counts as no less than this, so that powers stay finite; in the first lobe, whose gamma may be negative,
// the bound is higher. The exponent kappa cos^gamma is cut at its own bound, which only that lobe can reach while its
// kappa keeps to the largest.
inline constexpr double least_cosine = 1e-6;
inline constexpr double least_cosine_first_lobe = 0.02;
inline constexpr double largest_exponent = 12;

// The range that fits keep to.
inline constexpr double least_kappa = 1e-4, largest_kappa = largest_exponent;
inline constexpr double least_gamma = 0.03, largest_gamma = 5e4;
inline constexpr double least_signed_gamma = -3, largest_signed_gamma = 8;
DsbrdfChannel least_coefficients();
DsbrdfChannel largest_coefficients();

// Derivatives of the value of each channel.
struct DsbrdfSlopes {
  Eigen::Matrix3d kappa, gamma;  // channel x lobe: to the parameters of that channel's lobes
  Eigen::Vector3d cosine;        // to cos(theta_h)
};

// The nine lobes at one theta_d. With a constant view that is one direction of light, whatever the normal: a renderer
// takes them once a light and then asks for value(n . h) alone.
struct DsbrdfLobes {
  Eigen::Matrix3d kappa, gamma;  // channel x lobe

  Eigen::Vector3d value(double cos_theta_h) const;
  DsbrdfSlopes slopes(double cos_theta_h) const;
};

class Dsbrdf final : public Brdf {
 public:
  explicit Dsbrdf(const DsbrdfCoefficients& coefficients) : coefficients_(coefficients) {}

  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override;

  const DsbrdfCoefficients& coefficients() const { return coefficients_; }
  DsbrdfLobes lobes(double theta_d) const;
  // Row c: the derivatives of channel c's value to its own 36 coefficients; those to the others' are zero.
  Eigen::Matrix<double, 3, dsbrdf_channel_size> coefficient_slopes(double theta_d, double cos_theta_h) const;

 private:
  DsbrdfCoefficients coefficients_;
};

}  // namespace partwise
