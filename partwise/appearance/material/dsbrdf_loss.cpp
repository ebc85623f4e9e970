#include "partwise/appearance/material/dsbrdf_loss.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace partwise {
namespace {

constexpr double kLargestShare = 30;                // of a bin, over the mean
constexpr double kSmoothness = 0.05, kPull = 0.02;  // of the prior
constexpr double kDefaultKappa = 0.02;
constexpr std::array<double, dsbrdf_lobe_count> kDefaultGamma = {0.3, 15, 400};

using Column = Eigen::Array<double, half_angle_rows, 1>;

// Logarithms of cos(theta_h), as the first lobe and as the others take them.
std::array<Column, 2> log_cosines() {
  std::array<Column, 2> result;
  for (int row = 0; row < half_angle_rows; ++row) {
    const double cosine = std::cos(theta_h_of_row(row));
    result[0][row] = std::log(std::max(cosine, least_cosine_first_lobe));
    result[1][row] = std::log(std::max(cosine, least_cosine));
  }
  return result;
}

// The lobes of one column of the table: values, and their derivatives to the two curves of each.
struct ColumnModel {
  Column value = Column::Zero();
  Eigen::Array<double, half_angle_rows, 2 * dsbrdf_lobe_count> slopes;

  ColumnModel(const DsbrdfChannel& coefficients, const SplineWeights& weights, bool derivatives) {
    static const std::array<Column, 2> logs = log_cosines();
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      const auto curve = [&](DsbrdfCurve which) {
        return weights.dot(coefficients.segment<spline_size>(curve_offset(lobe, which)));
      };
      const Column& log_cosine = logs[lobe == 0 ? 0 : 1];
      const double gamma = lobe == 0 ? curve(DsbrdfCurve::gamma) : std::exp(curve(DsbrdfCurve::gamma));
      const Column exponent = (curve(DsbrdfCurve::kappa) + gamma * log_cosine).exp();
      const Column growth = exponent.min(largest_exponent).exp();
      value += growth - 1;
      if (!derivatives) continue;
      const Column slope = (exponent < largest_exponent).select(exponent * growth, 0.0);
      slopes.col(2 * lobe) = slope;
      slopes.col(2 * lobe + 1) = (lobe == 0 ? 1 : gamma) * log_cosine * slope;
    }
  }
};

void add_prior(const DsbrdfChannel& coefficients, bool derivatives, NormalEquations& sum) {
  static const DsbrdfChannel usual = default_channel();
  const auto add = [&](double weight, double residual, std::initializer_list<std::pair<int, double>> slopes) {
    sum.cost += 0.5 * weight * residual * residual;
    if (!derivatives) return;
    for (const auto& [i, a] : slopes) {
      sum.gradient[i] += weight * a * residual;
      for (const auto& [j, b] : slopes) sum.hessian(i, j) += weight * a * b;
    }
  };
  for (int i = 0; i < dsbrdf_channel_size; ++i) {
    add(kPull, coefficients[i] - usual[i], {{i, 1.0}});
    if (i % spline_size < 2) continue;
    add(kSmoothness, coefficients[i - 2] - 2 * coefficients[i - 1] + coefficients[i],
        {{i - 2, 1.0}, {i - 1, -2.0}, {i, 1.0}});
  }
}

}  // namespace

HalfAngleArray loss_weights(const HalfAngleArray& values, const HalfAngleArray& cosine) {
  HalfAngleArray energy = values * cosine;
  for (int row = 0; row < half_angle_rows; ++row) {
    const double theta = theta_h_of_row(row);
    energy.row(row) *= std::sin(theta) * std::sqrt(theta);  // the root: bins grow with it
  }
  for (int column = 0; column < half_angle_columns; ++column)
    energy.col(column) *= std::sin(2 * theta_d_of_column(column));
  const auto measured = cosine > 0;
  const double mean = std::max(energy.sum() / static_cast<double>(std::max<Eigen::Index>(measured.count(), 1)), 1e-300);
  return measured.select(0.5 + 0.5 * (energy / mean).min(kLargestShare), 0.0);
}

DsbrdfChannel default_channel() {
  DsbrdfChannel result;
  for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
    result.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::kappa)).setConstant(std::log(kDefaultKappa));
    result.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::gamma))
        .setConstant(lobe == 0 ? kDefaultGamma[0] : std::log(kDefaultGamma[lobe]));
  }
  return result;
}

DsbrdfLoss::DsbrdfLoss(const HalfAngleArray& values, const HalfAngleArray& cosine)
    : cosine_(cosine), target_((values * cosine + log_floor).log()), weights_(loss_weights(values, cosine)) {}

NormalEquations DsbrdfLoss::operator()(const DsbrdfChannel& coefficients, bool derivatives) const {
  constexpr int curves = 2 * dsbrdf_lobe_count;
  NormalEquations sum;
  if (derivatives) {
    sum.hessian = Eigen::MatrixXd::Zero(dsbrdf_channel_size, dsbrdf_channel_size);
    sum.gradient = Eigen::VectorXd::Zero(dsbrdf_channel_size);
  }
  for (int column = 0; column < half_angle_columns; ++column) {
    const SplineWeights spline = spline_weights(theta_d_of_column(column));
    const ColumnModel model(coefficients, spline, derivatives);
    const Column light = model.value * cosine_.col(column) + log_floor;
    const Column residual = light.log() - target_.col(column);
    const Column root = (1 + (residual / robust_delta).square()).sqrt();
    sum.cost += (weights_.col(column) * (root - 1)).sum() * robust_delta * robust_delta;
    if (!derivatives) continue;
    const Column weight = weights_.col(column) / root;
    const Eigen::Matrix<double, half_angle_rows, curves> jacobian =
        (model.slopes.colwise() * (cosine_.col(column) / light)).matrix();
    const Eigen::Matrix<double, half_angle_rows, curves> weighted = (jacobian.array().colwise() * weight).matrix();
    const Eigen::Matrix<double, curves, curves> square = weighted.transpose() * jacobian;
    const Eigen::Matrix<double, curves, 1> slope = weighted.transpose() * residual.matrix();
    // A column sees a curve only through its spline: one small product, spread out by the spline's weights.
    for (int a = 0; a < curves; ++a) {
      sum.gradient.segment<spline_size>(a * spline_size) += slope[a] * spline;
      for (int b = 0; b < curves; ++b) {
        sum.hessian.block<spline_size, spline_size>(a * spline_size, b * spline_size) +=
            square(a, b) * spline * spline.transpose();
      }
    }
  }
  add_prior(coefficients, derivatives, sum);
  return sum;
}

}  // namespace partwise
