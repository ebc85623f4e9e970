#include "partwise/appearance/material/dsbrdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace partwise {
namespace {

constexpr double kPi = std::numbers::pi;

// Any material within the range of fits, less a margin for finite differences.
DsbrdfCoefficients random_material(std::mt19937_64& random) {
  const DsbrdfChannel least = least_coefficients(), largest = largest_coefficients();
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  DsbrdfCoefficients result;
  for (int i = 0; i < dsbrdf_size; ++i) {
    const int k = i % dsbrdf_channel_size;
    result[i] = least[k] + uniform(random) * (largest[k] - least[k]);
  }
  return result;
}

TEST(Spline, IsAPartitionOfUnityWithOneWeightAtEachEnd) {
  for (int i = 0; i <= 1000; ++i) {
    const SplineWeights weights = spline_weights(i / 1000.0 * kPi / 2);
    EXPECT_NEAR(weights.sum(), 1, 1e-14);
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_LE((weights.array() > 0).count(), 4);
  }
  EXPECT_EQ(spline_weights(0), SplineWeights::Unit(0));
  EXPECT_EQ(spline_weights(kPi / 2), SplineWeights::Unit(5));
  EXPECT_EQ(spline_weights(-1), SplineWeights::Unit(0));
  EXPECT_EQ(spline_weights(9), SplineWeights::Unit(5));
}

// By Marsden's identity the coefficients of x^3 are products of neighbouring knots, and those of x their means.
TEST(Spline, HoldsEveryCubic) {
  const double a = kPi / 6, b = kPi / 3, c = kPi / 2;
  SplineWeights cube;
  cube << 0, 0, 0, a * b * c, b * c * c, c * c * c;
  SplineWeights line;
  line << 0, a / 3, (a + b) / 3, (a + b + c) / 3, (b + c + c) / 3, c;
  for (int i = 0; i <= 100; ++i) {
    const double x = i / 100.0 * c;
    EXPECT_NEAR(spline_weights(x).dot(cube), x * x * x, 1e-13);
    EXPECT_NEAR(spline_weights(x).dot(line), x, 1e-13);
  }
}

// The integral over the hemisphere of half-vectors has a series: 2 pi * sum over n >= 1 of kappa^n / (n! (gamma n +
// 1)).
TEST(Dsbrdf, LobeHasTheIntegralOfItsSeries) {
  for (const double kappa : {0.01, 0.5, 3.0, 8.0}) {
    for (const double gamma : {0.3, 1.0, 7.5, 400.0}) {
      DsbrdfLobes lobes{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Ones()};
      lobes.kappa(1, 2) = kappa;
      lobes.gamma(1, 2) = gamma;
      double sum = 0;  // over t, with cosine = 1 - t^3, which is fine where a sharp lobe is
      const int steps = 20000;
      for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        sum += 2 * kPi * lobes.value(1 - t * t * t)[1] * 3 * t * t / steps;
      }
      double series = 0, term = 1;
      for (int n = 1; n < 80; ++n) {
        term *= kappa / n;
        series += 2 * kPi * term / (gamma * n + 1);
      }
      EXPECT_NEAR(sum / series, 1, 1e-5) << kappa << " " << gamma;
    }
  }
}

TEST(Dsbrdf, SlopesAreThoseOfFiniteDifferences) {
  std::mt19937_64 random(4);
  const double step = 1e-6;
  for (int trial = 0; trial < 100; ++trial) {
    const Dsbrdf brdf(random_material(random));
    const double theta_d = std::uniform_real_distribution<double>(0, kPi / 2)(random);
    const double u = std::cos(std::pow(std::uniform_real_distribution<double>(0, 1)(random), 2) * 1.5);
    const DsbrdfLobes lobes = brdf.lobes(theta_d);
    const Eigen::Vector3d value = lobes.value(u);
    const DsbrdfSlopes slopes = lobes.slopes(u);
    const auto expect_slope = [&](double slope, double after, double before, double h, double scale) {
      EXPECT_NEAR(slope * scale, (after - before) / (2 * h) * scale, 1e-6 * (1 + value.maxCoeff()));
    };
    for (int channel = 0; channel < 3; ++channel) {
      for (int r = 0; r < dsbrdf_lobe_count; ++r) {
        for (auto [matrix, slope] : {std::pair(&DsbrdfLobes::kappa, slopes.kappa(channel, r)),
                                     std::pair(&DsbrdfLobes::gamma, slopes.gamma(channel, r))}) {
          const double scale = std::max(std::abs((lobes.*matrix)(channel, r)), 1e-3), h = step * scale;
          DsbrdfLobes after = lobes, before = lobes;
          (after.*matrix)(channel, r) += h;
          (before.*matrix)(channel, r) -= h;
          expect_slope(slope, after.value(u)[channel], before.value(u)[channel], h, scale);
        }
      }
      const double h = 1e-9;  // the sharpest lobe is 1e-3 wide in the cosine's root
      const double difference = (lobes.value(u + h)[channel] - lobes.value(u - h)[channel]) / (2 * h);
      EXPECT_NEAR(slopes.cosine[channel], difference, 1e-4 * std::abs(difference) + 1e-5 * (1 + value[channel]));
    }
    const auto gradients = brdf.coefficient_slopes(theta_d, u);
    for (int i = 0; i < dsbrdf_size; ++i) {
      DsbrdfCoefficients after = brdf.coefficients(), before = after;
      after[i] += step;
      before[i] -= step;
      const int channel = i / dsbrdf_channel_size;
      const Eigen::Vector3d high = Dsbrdf(after).lobes(theta_d).value(u), low = Dsbrdf(before).lobes(theta_d).value(u);
      expect_slope(gradients(channel, i % dsbrdf_channel_size), high[channel], low[channel], step, 1);
      for (const int other : {(channel + 1) % 3, (channel + 2) % 3}) EXPECT_EQ(high[other], low[other]);
    }
  }
}

TEST(Dsbrdf, IsReciprocalAndOfTheHalfVectorAlone) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> quarter(0, kPi / 2), turn(-kPi, kPi);
  const Dsbrdf brdf(random_material(random));
  for (int i = 0; i < 500; ++i) {
    const HalfAngles angles{quarter(random), quarter(random), turn(random)};
    const DirectionPair pair = directions_of(angles);
    const Eigen::Vector3f light = pair.to_light.cast<float>(), viewer = pair.to_viewer.cast<float>();
    EXPECT_EQ(brdf(light, viewer), brdf(viewer, light));
    if (light.z() <= 0 || viewer.z() <= 0) {
      EXPECT_EQ(brdf(light, viewer), Eigen::Vector3f::Zero());
      continue;
    }
    const HalfAngles rounded = half_angles(light.cast<double>(), viewer.cast<double>());
    const Eigen::Vector3d expected = brdf.lobes(rounded.theta_d).value(std::cos(rounded.theta_h));
    EXPECT_LT((brdf(light, viewer).cast<double>() - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(Dsbrdf, IsFiniteAtEveryEndOfItsRange) {
  for (const DsbrdfChannel& channel : {least_coefficients(), largest_coefficients()}) {
    const Dsbrdf brdf(channel.replicate<3, 1>());
    for (const double theta_d : {0.0, 0.7, kPi / 2}) {
      for (const double u : {-1.0, 0.0, 1e-9, 0.5, 1.0, 1 + 1e-12}) {
        const Eigen::Vector3d value = brdf.lobes(theta_d).value(u);
        EXPECT_TRUE(value.allFinite());
        EXPECT_GE(value.minCoeff(), 0);
        EXPECT_LE(value.maxCoeff(), 3 * std::exp(largest_exponent));
        EXPECT_TRUE(brdf.coefficient_slopes(theta_d, u).allFinite());
      }
    }
  }
}

// A negative gamma in the first lobe makes it rise towards grazing half-vectors, as cloth does; the others cannot.
TEST(Dsbrdf, FirstLobeMayRiseTowardsGrazing) {
  DsbrdfLobes lobes{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Ones()};
  lobes.kappa(0, 0) = 0.1;
  lobes.gamma(0, 0) = -1;
  EXPECT_GT(lobes.value(0.2)[0], lobes.value(0.9)[0]);
  EXPECT_NEAR(lobes.value(0.5)[0], std::expm1(0.2), 1e-15);
  EXPECT_EQ(lobes.value(0)[0], lobes.value(least_cosine_first_lobe)[0]);
}

}  // namespace
}  // namespace partwise
