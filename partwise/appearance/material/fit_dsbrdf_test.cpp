#include "partwise/appearance/material/fit_dsbrdf.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/appearance/material/dsbrdf_loss.h"
#include "partwise/appearance/material/levenberg_marquardt.h"
#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

// A glossy plastic: a broad lobe and two sharper ones, whose curves change with theta_d and with the channel.
Dsbrdf glossy(double gamma_second = 40) {
  DsbrdfCoefficients c;
  for (int channel = 0; channel < 3; ++channel) {
    for (int i = 0; i < spline_size; ++i) {
      const auto at = [&](int lobe, DsbrdfCurve curve) -> double& {
        return c[channel * dsbrdf_channel_size + curve_offset(lobe, curve) + i];
      };
      at(0, DsbrdfCurve::kappa) = std::log(0.05 * (channel + 1)) + 0.1 * i;
      at(0, DsbrdfCurve::gamma) = 0.5 - 0.1 * i;
      at(1, DsbrdfCurve::kappa) = std::log(0.4) + 0.05 * i;
      at(1, DsbrdfCurve::gamma) = std::log(gamma_second);
      at(2, DsbrdfCurve::kappa) = std::log(2.0) + 0.1 * i;
      at(2, DsbrdfCurve::gamma) = std::log(900.0) - 0.1 * i;
    }
  }
  return Dsbrdf(c);
}

double slope_of_sums(const Dsbrdf& brdf) {
  return (brdf.coefficients().segment<spline_size>(curve_offset(2, DsbrdfCurve::gamma)) -
          brdf.coefficients().segment<spline_size>(curve_offset(1, DsbrdfCurve::gamma)))
      .sum();
}

TEST(FitDsbrdf, FindsWhatTheTableWasMadeFrom) {
  const HalfAngleTable measured = mean_over_phi(tabulate(glossy()));
  const Dsbrdf fit = fit_dsbrdf(measured);
  EXPECT_LT(log_rmse(measured, fit), 0.02);
  EXPECT_GT(slope_of_sums(fit), 0) << "lobes from broad to sharp";
}

TEST(FitDsbrdf, MatteSurfacesAreFlat) {
  const MicrofacetBrdf matte({0.6, 0.3, 0.05});
  const HalfAngleTable measured = mean_over_phi(tabulate(matte));
  const Dsbrdf fit = fit_dsbrdf(measured);
  EXPECT_LT(log_rmse(measured, fit), 0.02);
  const Eigen::Vector3d value = fit.lobes(0.5).value(0.8);
  EXPECT_LT((value - matte.diffuse() / std::numbers::pi).norm(), 0.01 * value.norm());
}

TEST(FitDsbrdf, HardlyMovesForAFewWildValues) {
  const HalfAngleTable measured = mean_over_phi(tabulate(glossy()));
  HalfAngleTable wild = measured;
  std::mt19937_64 random(3);
  for (int i = 0; i < half_angle_rows * half_angle_columns / 100; ++i) {
    const int row = static_cast<int>(random() % (half_angle_rows - 20)),
              column = static_cast<int>(random() % half_angle_columns);
    for (HalfAngleArray& values : wild.values) values(row + 20, column) *= 20;
  }
  EXPECT_LT(log_rmse(measured, fit_dsbrdf(wild)), 0.12);
  EXPECT_GT(log_rmse(measured, wild), 0.24);
}

TEST(FitDsbrdf, IsTheSameForAnyNumberOfThreads) {
  const HalfAngleTable measured = mean_over_phi(tabulate(glossy(80)));
  const Dsbrdf many = fit_dsbrdf(measured);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(fit_dsbrdf(measured).coefficients(), many.coefficients());
}

TEST(FitDsbrdf, RefusesWhatWasNeverMeasured) { EXPECT_THROW(fit_dsbrdf(mean_over_phi(MerlTable())), InputError); }

TEST(DsbrdfLoss, GradientIsThatOfFiniteDifferences) {
  const HalfAngleTable measured = mean_over_phi(tabulate(glossy()));
  const DsbrdfLoss loss(measured.values[1], measured.cosine);
  const DsbrdfChannel least = least_coefficients(), largest = largest_coefficients();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0.3, 0.7);
  for (int trial = 0; trial < 5; ++trial) {
    DsbrdfChannel x;
    for (int i = 0; i < dsbrdf_channel_size; ++i) x[i] = least[i] + uniform(random) * (largest[i] - least[i]);
    const NormalEquations normal = loss(x, true);
    EXPECT_DOUBLE_EQ(normal.cost, loss(x, false).cost);
    for (int i = 0; i < dsbrdf_channel_size; ++i) {
      const DsbrdfChannel step = 1e-5 * DsbrdfChannel::Unit(i);
      const double difference = (loss(x + step, false).cost - loss(x - step, false).cost) / 2e-5;
      EXPECT_NEAR(normal.gradient[i], difference, 1e-6 * (1 + normal.cost));
    }
  }
}

// Half the energy-weighted squares: at the model's own table nothing but the prior is left.
TEST(DsbrdfLoss, IsThePriorAloneAtTheTruth) {
  const Dsbrdf truth = glossy();
  const HalfAngleTable measured = mean_over_phi(tabulate(truth));
  HalfAngleTable exact = measured;
  for (int row = 0; row < half_angle_rows; ++row) {
    for (int column = 0; column < half_angle_columns; ++column) {
      const Eigen::Vector3d value = truth.lobes(theta_d_of_column(column)).value(std::cos(theta_h_of_row(row)));
      for (int channel = 0; channel < 3; ++channel) exact.values[channel](row, column) = value[channel];
    }
  }
  const DsbrdfChannel x = truth.coefficients().head<dsbrdf_channel_size>();
  const DsbrdfChannel pull = x - default_channel();
  double prior = 0.5 * 0.02 * pull.squaredNorm();
  for (int i = 0; i < dsbrdf_channel_size; ++i) {
    if (i % spline_size >= 2) prior += 0.5 * 0.05 * std::pow(x[i - 2] - 2 * x[i - 1] + x[i], 2);
  }
  EXPECT_NEAR(DsbrdfLoss(exact.values[0], exact.cosine)(x, false).cost, prior, 1e-9);
}

// Rosenbrock's valley as least squares, free and with a bound across the way to its minimum at (1, 1).
TEST(LevenbergMarquardt, FollowsRosenbrocksValleyAndRestsOnABound) {
  const LeastSquares valley = [](const Eigen::VectorXd& x, bool) {
    const Eigen::Vector2d residuals(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
    Eigen::Matrix2d jacobian;
    jacobian << -20 * x[0], 10, -1, 0;
    return NormalEquations{0.5 * residuals.squaredNorm(), jacobian.transpose() * jacobian,
                           jacobian.transpose() * residuals};
  };
  const Eigen::Vector2d start(-1.2, 1), wide(10, 10);
  const LeastSquaresSettings patient{.iterations = 500, .convergence = 1e-14};
  EXPECT_LT((minimise(valley, start, -wide, wide, patient).variables - Eigen::Vector2d(1, 1)).norm(), 1e-6);
  const Minimum bounded = minimise(valley, start, -wide, Eigen::Vector2d(0.5, 10), patient);
  EXPECT_LT((bounded.variables - Eigen::Vector2d(0.5, 0.25)).norm(), 1e-6);
  EXPECT_NEAR(bounded.cost, 0.125, 1e-9);
}

}  // namespace
}  // namespace partwise
