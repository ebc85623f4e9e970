#include "partwise/parts/surface/gaussian_mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Points drawn from known Gaussians in two dimensions.
Eigen::MatrixXd three_clouds(int count, std::mt19937_64& random) {
  const double means[3][2] = {{0.1, 0.5}, {0.5, 0.2}, {0.8, 0.9}}, deviations[3] = {0.03, 0.06, 0.04};
  std::normal_distribution<double> normal;
  Eigen::MatrixXd points(count, 2);
  for (int i = 0; i < count; ++i) {
    const int c = i % 10 < 5 ? 0 : i % 10 < 8 ? 1 : 2;  // shares of 0.5, 0.3 and 0.2
    for (int k = 0; k < 2; ++k) points(i, k) = means[c][k] + deviations[c] * normal(random);
  }
  return points;
}

TEST(GaussianMixture, RecoversWhatThePointsWereDrawnFrom) {
  std::mt19937_64 random(3);
  const int count = 20000;
  const GaussianMixture mixture = fit_mixture(three_clouds(count, random), {}, {.components = 3});
  Eigen::MatrixXd means(3, 2), deviations(3, 2);
  means << 0.1, 0.5, 0.5, 0.2, 0.8, 0.9;
  deviations << 0.03, 0.03, 0.06, 0.06, 0.04, 0.04;
  const double noise = 5 * 0.06 / std::sqrt(0.2 * count);  // five standard errors of the least certain
  EXPECT_LT((mixture.means - means).cwiseAbs().maxCoeff(), noise);
  EXPECT_LT((mixture.deviations - deviations).cwiseAbs().maxCoeff(), noise);
  EXPECT_LT((mixture.shares - Eigen::Vector3d(0.5, 0.3, 0.2)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(GaussianMixture, OneComponentIsMeanAndDeviation) {
  std::mt19937_64 random(4);
  const Eigen::MatrixXd points = three_clouds(500, random);
  const GaussianMixture mixture = fit_mixture(points, {}, {.components = 1});
  EXPECT_LT((mixture.means.row(0) - points.colwise().mean()).norm(), 1e-12);
  const Eigen::RowVectorXd variance = (points.rowwise() - points.colwise().mean()).array().square().colwise().mean();
  EXPECT_LT((mixture.deviations.row(0).array().square().matrix() - variance).norm(), 1e-12);
  // Of a Gaussian with its own moments: -(1 + log(2 pi variance)) / 2 a coordinate.
  const double expected = -0.5 * (1 + (2 * std::numbers::pi * variance.array()).log()).sum();
  EXPECT_NEAR(mixture.log_likelihood, expected, 1e-9);
}

TEST(GaussianMixture, AWeightIsARepetition) {
  std::mt19937_64 random(5);
  const Eigen::MatrixXd points = three_clouds(300, random);
  Eigen::VectorXd weights(300);
  std::vector<int> repeated;
  for (int i = 0; i < 300; ++i) {
    weights[i] = i % 3;
    repeated.insert(repeated.end(), static_cast<std::size_t>(i % 3), i);
  }
  const MixtureSettings settings{.components = 3, .iterations = 500, .convergence = 1e-12};
  const GaussianMixture weighted = fit_mixture(points, weights, settings);
  const GaussianMixture plain = fit_mixture(Eigen::MatrixXd(points(repeated, Eigen::all)), {}, settings);
  EXPECT_LT((weighted.means - plain.means).norm(), 1e-5);
  EXPECT_LT((weighted.deviations - plain.deviations).norm(), 1e-5);
  EXPECT_NEAR(weighted.log_likelihood, plain.log_likelihood, 1e-6);
}

TEST(GaussianMixture, MoreIterationsNeverLoseLikelihood) {
  std::mt19937_64 random(6);
  const Eigen::MatrixXd points = three_clouds(1000, random);
  double before = -1e300;
  for (int iterations : {0, 1, 2, 5, 10, 50}) {
    const double now =
        fit_mixture(points, {}, {.components = 5, .iterations = iterations, .convergence = 0}).log_likelihood;
    EXPECT_GE(now, before - 1e-12);
    before = now;
  }
}

TEST(GaussianMixture, ResponsibilitiesAreProbabilities) {
  std::mt19937_64 random(7);
  const Eigen::MatrixXd points = three_clouds(1000, random);
  const GaussianMixture mixture = fit_mixture(points, {}, {.components = 4});
  const Eigen::MatrixXd shares = mixture.responsibilities(points);
  EXPECT_GE(shares.minCoeff(), 0);
  EXPECT_LT((shares.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  const Eigen::MatrixXd far = Eigen::MatrixXd::Constant(1, 2, 1e6);  // Densities there are 0 in double precision.
  EXPECT_NEAR(mixture.responsibilities(far).sum(), 1, 1e-12);
}

TEST(GaussianMixture, FewDistinctPointsGiveFewComponents) {
  Eigen::MatrixXd points(6, 1);
  points << 0, 0, 0, 1, 1, 1;
  const GaussianMixture mixture = fit_mixture(points, {}, {.components = 5});
  ASSERT_EQ(mixture.means.rows(), 2);
  EXPECT_EQ(mixture.means(0, 0), 0);
  EXPECT_EQ(mixture.means(1, 0), 1);
  EXPECT_EQ(mixture.deviations(0, 0), MixtureSettings{}.least_deviation);
  const GaussianMixture constant = fit_mixture(Eigen::MatrixXd::Constant(9, 1, 0.5), {}, {.components = 3});
  EXPECT_EQ(constant.means.rows(), 1);
}

TEST(GaussianMixture, SameSeedSameResult) {
  std::mt19937_64 random(8);
  const Eigen::MatrixXd points = three_clouds(2000, random);
  const GaussianMixture a = fit_mixture(points, {}, {.components = 6}), b = fit_mixture(points, {}, {.components = 6});
  EXPECT_EQ(a.means, b.means);
  EXPECT_EQ(a.log_likelihood, b.log_likelihood);
}

TEST(GaussianMixture, RefusesWhatItCannotUse) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, 1);
  EXPECT_THROW(fit_mixture(points, {}, {.components = 0}), InputError);
  EXPECT_THROW(fit_mixture(points, {}, {.restarts = 0}), InputError);
  EXPECT_THROW(fit_mixture(points, Eigen::VectorXd::Ones(2)), InputError);
  EXPECT_THROW(fit_mixture(points, Eigen::VectorXd::Zero(3)), InputError);
  EXPECT_THROW(fit_mixture(Eigen::MatrixXd::Constant(3, 1, NAN), {}), InputError);
  EXPECT_THROW(fit_mixture(Eigen::MatrixXd(0, 1), {}), InputError);
}

}  // namespace
}  // namespace partwise
