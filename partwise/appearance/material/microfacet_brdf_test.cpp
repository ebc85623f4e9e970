#include "partwise/appearance/material/microfacet_brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double kPi = std::numbers::pi;

// The share of light from one direction that is sent on, by channel.
Eigen::Vector3d albedo(const Brdf& brdf, double theta) {
  const Eigen::Vector3f light(static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta)));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int rows = 400, columns = 400;
  for (int row = 0; row < rows; ++row) {
    const double z = std::sqrt((row + 0.5) / rows), across = std::sqrt(1 - z * z);  // even in the cosine's measure
    for (int column = 0; column < columns; ++column) {
      const double phi = 2 * kPi * (column + 0.5) / columns;
      const Eigen::Vector3d viewer(across * std::cos(phi), across * std::sin(phi), z);
      sum += brdf(light, viewer.cast<float>()).cast<double>() * kPi / (rows * columns);
    }
  }
  return sum;
}

TEST(MicrofacetBrdf, LambertSendsOnItsAlbedo) {
  const Eigen::Vector3d diffuse(0.8, 0.3, 0.01);
  for (const double theta : {0.0, 0.7, 1.4}) EXPECT_LT((albedo(MicrofacetBrdf(diffuse), theta) - diffuse).norm(), 1e-6);
}

TEST(MicrofacetBrdf, DistributionsOfNormalsAreNormalised) {
  for (const double roughness : {0.1, 0.3, 1.0}) {
    double beckmann = 0, ggx = 0;
    const int steps = 200000;
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps;
      beckmann += 2 * kPi * u * beckmann_distribution(u, roughness) / steps;
      ggx += 2 * kPi * u * ggx_distribution(u, roughness) / steps;
    }
    EXPECT_NEAR(beckmann, 1, 1e-4);
    EXPECT_NEAR(ggx, 1, 1e-4);
  }
}

// With a reflectance of 1 and no diffuse part no more than all may come back; single scattering loses some.
TEST(MicrofacetBrdf, WhiteFurnaceGainsNothing) {
  for (const LobeShape shape : {LobeShape::cook_torrance, LobeShape::ggx}) {
    for (const double roughness : {0.2, 0.5, 1.0}) {
      const MicrofacetBrdf brdf({0, 0, 0}, shape, {{roughness, {1, 1, 1}}});
      for (const double theta : {0.0, 0.6, 1.2}) {
        const double share = albedo(brdf, theta)[0];
        EXPECT_LE(share, 1.002) << roughness << " " << theta;
        EXPECT_GE(share, roughness < 0.3 ? 0.85 : 0.3) << roughness << " " << theta;
      }
    }
  }
}

// Of GGX with roughness 1 and light from above the integral is one of z / (1 + z): 1 - log 2.
TEST(MicrofacetBrdf, RoughestGgxHasItsClosedForm) {
  const MicrofacetBrdf brdf({0, 0, 0}, LobeShape::ggx, {{1, {1, 1, 1}}});
  EXPECT_NEAR(albedo(brdf, 0)[0], 1 - std::numbers::ln2, 1e-5);
}

TEST(MicrofacetBrdf, IsReciprocal) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (const LobeShape shape : {LobeShape::blinn_phong, LobeShape::cook_torrance, LobeShape::ggx}) {
    const MicrofacetBrdf brdf({0.2, 0.1, 0.4}, shape, {{0.3, {0.04, 0.05, 0.9}}, {0.05, {0.5, 0.1, 0.2}}});
    for (int i = 0; i < 200; ++i) {
      Eigen::Vector3f a(normal(random), normal(random), std::abs(normal(random)) + 0.01f);
      Eigen::Vector3f b(normal(random), normal(random), std::abs(normal(random)) + 0.01f);
      a.normalize();
      b.normalize();
      EXPECT_LT((brdf(a, b) - brdf(b, a)).norm(), 1e-5f * brdf(a, b).norm());
    }
  }
}

TEST(FitMicrofacets, FindsWhatTheTableWasMadeFrom) {
  for (const LobeShape shape : {LobeShape::blinn_phong, LobeShape::cook_torrance, LobeShape::ggx}) {
    const MicrofacetBrdf truth({0.3, 0.1, 0.05}, shape, {{0.15, {0.05, 0.04, 0.06}}});
    const HalfAngleTable measured = mean_over_phi(tabulate(truth));
    const MicrofacetBrdf fit = fit_microfacets(measured, shape, 1);
    EXPECT_LT(log_rmse(measured, fit), 0.03);
    EXPECT_NEAR(fit.lobes()[0].roughness, 0.15, 0.005);
    EXPECT_LT((fit.diffuse() - truth.diffuse()).norm(), 0.01);
  }
}

TEST(FitMicrofacets, MoreLobesComeNearer) {
  const MicrofacetBrdf truth({0.1, 0.1, 0.1}, LobeShape::ggx, {{0.4, {0.1, 0.1, 0.1}}, {0.03, {0.2, 0.2, 0.2}}});
  const HalfAngleTable measured = mean_over_phi(tabulate(truth));
  const double one = log_rmse(measured, fit_microfacets(measured, LobeShape::ggx, 1));
  const double two = log_rmse(measured, fit_microfacets(measured, LobeShape::ggx, 2));
  EXPECT_LT(two, 0.03);
  EXPECT_GT(one, 3 * two);
}

TEST(MicrofacetBrdf, RefusesRoughnessOutOfRange) {
  EXPECT_THROW(MicrofacetBrdf({1, 1, 1}, LobeShape::ggx, {{0, {1, 1, 1}}}), CheckFailed);
  EXPECT_THROW(MicrofacetBrdf({1, 1, 1}, LobeShape::ggx, {{1.1, {1, 1, 1}}}), CheckFailed);
}

}  // namespace
}  // namespace partwise
