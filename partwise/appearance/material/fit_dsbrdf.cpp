#include "partwise/appearance/material/fit_dsbrdf.h"

#include <tbb/parallel_for.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "partwise/appearance/material/dsbrdf_loss.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

// Sharpness of the lobes to start from: of broad highlights, and of narrow ones.
constexpr std::array<std::array<double, dsbrdf_lobe_count>, 2> kStarts = {{{0.3, 15, 400}, {0.3, 60, 3000}}};

int row_of(double degrees) {
  const double theta = degrees * std::numbers::pi / 180;
  return std::min(static_cast<int>(half_angle_rows * std::sqrt(theta / (std::numbers::pi / 2))), half_angle_rows - 1);
}

// The first lobe has the level at 50 degrees, the second what is added at 8, the third what is added at the peak.
DsbrdfChannel start_from(const HalfAngleArray& values, const std::array<double, dsbrdf_lobe_count>& gamma) {
  Eigen::Matrix<double, half_angle_columns, spline_size> splines;
  Eigen::Matrix<double, half_angle_columns, dsbrdf_lobe_count> log_kappa;
  for (int column = 0; column < half_angle_columns; ++column) {
    splines.row(column) = spline_weights(theta_d_of_column(column)).transpose();
    const auto f = values.col(column);
    const double base = f[row_of(50)], skirt = f[row_of(8)], peak = f.head(row_of(8)).maxCoeff();
    const std::array<double, dsbrdf_lobe_count> levels = {base, skirt - base, peak - skirt};
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      log_kappa(column, lobe) =
          std::log(std::clamp(std::log1p(std::max(levels[lobe], 0.0)), least_kappa, largest_kappa));
    }
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(splines);
  DsbrdfChannel start;
  for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
    start.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::kappa)) = solver.solve(log_kappa.col(lobe));
    start.segment<spline_size>(curve_offset(lobe, DsbrdfCurve::gamma))
        .setConstant(lobe == 0 ? gamma[0] : std::log(gamma[lobe]));
  }
  return start;
}

Minimum fit_channel(const HalfAngleArray& values, const HalfAngleArray& cosine, const Eigen::VectorXd& start) {
  const DsbrdfLoss loss(values, cosine);
  return minimise([&](const Eigen::VectorXd& c, bool derivatives) { return loss(DsbrdfChannel(c), derivatives); },
                  start, least_coefficients(), largest_coefficients());
}

// The second lobe is the broader of the other two, in all channels alike.
void order_lobes(DsbrdfCoefficients& coefficients) {
  const int second = curve_offset(1, DsbrdfCurve::kappa), third = curve_offset(2, DsbrdfCurve::kappa);
  double difference = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const auto at = [&](int lobe) {
      return coefficients.segment<spline_size>(channel * dsbrdf_channel_size + curve_offset(lobe, DsbrdfCurve::gamma))
          .sum();
    };
    difference += at(2) - at(1);
  }
  if (difference >= 0) return;
  for (int channel = 0; channel < 3; ++channel) {
    auto own = coefficients.segment<dsbrdf_channel_size>(channel * dsbrdf_channel_size);
    own.segment<2 * spline_size>(second).swap(own.segment<2 * spline_size>(third));
  }
}

}  // namespace

Dsbrdf fit_dsbrdf(const HalfAngleTable& measured) {
  if (!(measured.cosine > 0).any())
    throw InputError("material", "nothing was measured above the horizon", "give a material that reflects");
  const HalfAngleArray mean = (measured.values[0] + measured.values[1] + measured.values[2]) / 3;
  std::array<Minimum, kStarts.size()> tried;
  tbb::parallel_for(std::size_t{0}, kStarts.size(), [&](std::size_t i) {
    tried[i] = fit_channel(mean, measured.cosine, start_from(mean, kStarts[i]));
  });
  const Minimum& best = *std::ranges::min_element(tried, {}, &Minimum::cost);
  DsbrdfCoefficients coefficients;
  tbb::parallel_for(0, 3, [&](int channel) {
    coefficients.segment<dsbrdf_channel_size>(channel * dsbrdf_channel_size) =
        fit_channel(measured.values[channel], measured.cosine, best.variables).variables;
  });
  order_lobes(coefficients);
  return Dsbrdf(coefficients);
}

}  // namespace partwise
