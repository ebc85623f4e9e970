#include "partwise/appearance/material/dsbrdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace partwise {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

double floor_of_cosine(int lobe) { return lobe == 0 ? least_cosine_first_lobe : least_cosine; }

// One lobe at one half-vector.
struct Lobe {
  double power = 0;     // cos^gamma
  double exponent = 0;  // kappa cos^gamma, cut
  double log_cosine = 0;
  bool cut = false, at_least_cosine = false;

  Lobe(int lobe, double kappa, double gamma, double cosine) {
    const double least = floor_of_cosine(lobe);
    at_least_cosine = cosine <= least;
    log_cosine = std::log(std::clamp(cosine, least, 1.0));
    power = std::exp(gamma * log_cosine);
    cut = kappa * power >= largest_exponent;
    exponent = std::min(kappa * power, largest_exponent);
  }
};

DsbrdfChannel channel_of(double kappa, double signed_gamma, double gamma) {
  DsbrdfChannel result;
  for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
    result.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::kappa)).setConstant(std::log(kappa));
    result.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::gamma))
        .setConstant(lobe == 0 ? signed_gamma : std::log(gamma));
  }
  return result;
}

}  // namespace

SplineWeights spline_weights(double theta_d) {
  constexpr int degree = 3, knots = spline_size + degree + 1;
  constexpr std::array<double, knots> knot = {0,        0,        0,        0,       kQuarter / 3, 2 * kQuarter / 3,
                                              kQuarter, kQuarter, kQuarter, kQuarter};
  const double theta = std::clamp(theta_d, 0.0, kQuarter);
  int span = degree;
  while (span < spline_size - 1 && theta >= knot[span + 1]) ++span;
  std::array<double, knots - 1> weight{};  // Cox and de Boor's recursion, from degree 0 upwards
  weight[span] = 1;
  for (int k = 1; k <= degree; ++k) {
    for (int i = span - k; i <= span; ++i) {
      const double rising = knot[i + k] > knot[i] ? (theta - knot[i]) / (knot[i + k] - knot[i]) * weight[i] : 0;
      const double width = knot[i + k + 1] - knot[i + 1];
      const double falling = i < span && width > 0 ? (knot[i + k + 1] - theta) / width * weight[i + 1] : 0;
      weight[i] = rising + falling;
    }
  }
  return Eigen::Map<const SplineWeights>(weight.data());
}

DsbrdfChannel least_coefficients() { return channel_of(least_kappa, least_signed_gamma, least_gamma); }

DsbrdfChannel largest_coefficients() { return channel_of(largest_kappa, largest_signed_gamma, largest_gamma); }

Eigen::Vector3d DsbrdfLobes::value(double cos_theta_h) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int channel = 0; channel < 3; ++channel) {
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      sum[channel] += std::expm1(Lobe(lobe, kappa(channel, lobe), gamma(channel, lobe), cos_theta_h).exponent);
    }
  }
  return sum;
}

DsbrdfSlopes DsbrdfLobes::slopes(double cos_theta_h) const {
  DsbrdfSlopes result{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()};
  for (int channel = 0; channel < 3; ++channel) {
    for (int r = 0; r < dsbrdf_lobe_count; ++r) {
      const double k = kappa(channel, r), g = gamma(channel, r);
      const Lobe lobe(r, k, g, cos_theta_h);
      if (lobe.cut) continue;
      const double growth = std::exp(lobe.exponent);
      result.kappa(channel, r) = lobe.power * growth;
      result.gamma(channel, r) = lobe.exponent * lobe.log_cosine * growth;
      if (!lobe.at_least_cosine) result.cosine[channel] += lobe.exponent * g / cos_theta_h * growth;
    }
  }
  return result;
}

DsbrdfLobes Dsbrdf::lobes(double theta_d) const {
  const SplineWeights weights = spline_weights(theta_d);
  DsbrdfLobes result;
  for (int channel = 0; channel < 3; ++channel) {
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      const auto curve = [&](DsbrdfCurve which) {
        return weights.dot(
            coefficients_.segment<spline_size>(channel * dsbrdf_channel_size + curve_offset(lobe, which)));
      };
      result.kappa(channel, lobe) = std::exp(curve(DsbrdfCurve::kappa));
      const double gamma = curve(DsbrdfCurve::gamma);
      result.gamma(channel, lobe) = lobe == 0 ? gamma : std::exp(gamma);
    }
  }
  return result;
}

Eigen::Matrix<double, 3, dsbrdf_channel_size> Dsbrdf::coefficient_slopes(double theta_d, double cos_theta_h) const {
  const SplineWeights weights = spline_weights(theta_d);
  const DsbrdfLobes at = lobes(theta_d);
  const DsbrdfSlopes slopes = at.slopes(cos_theta_h);
  Eigen::Matrix<double, 3, dsbrdf_channel_size> result;
  for (int channel = 0; channel < 3; ++channel) {
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      const auto curve = [&](DsbrdfCurve which) {
        return result.block<1, spline_size>(channel, curve_offset(lobe, which));
      };
      curve(DsbrdfCurve::kappa) = slopes.kappa(channel, lobe) * at.kappa(channel, lobe) * weights.transpose();
      curve(DsbrdfCurve::gamma) =
          slopes.gamma(channel, lobe) * (lobe == 0 ? 1 : at.gamma(channel, lobe)) * weights.transpose();
    }
  }
  return result;
}

Eigen::Vector3f Dsbrdf::operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const {
  if (!(to_light.z() > 0 && to_viewer.z() > 0)) return Eigen::Vector3f::Zero();
  const HalfAngles angles = half_angles(to_light.cast<double>(), to_viewer.cast<double>());
  return lobes(angles.theta_d).value(std::cos(angles.theta_h)).cast<float>();
}

}  // namespace partwise
