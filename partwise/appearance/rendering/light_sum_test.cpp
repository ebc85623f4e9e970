#include "partwise/appearance/rendering/light_sum.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/halfway_table.h"
#include "partwise/appearance/rendering/shading_frame.h"
#include "partwise/appearance/rendering/test_scenes.h"

namespace partwise {
namespace {

// Hides what it is, so that the sum asks for every pair.
class Plain final : public Brdf {
 public:
  explicit Plain(const Brdf& brdf) : brdf_(brdf) {}
  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override {
    return brdf_(to_light, to_viewer);
  }

 private:
  const Brdf& brdf_;
};

LightSamples noisy_light(int width, int height) {
  std::mt19937 random(3);
  std::exponential_distribution<float> value(1);
  Image map(width, height, 3);
  for (float& each : map.values) each = value(random);
  return light_samples(EnvironmentLight(std::move(map)));
}

std::vector<Eigen::Vector3f> random_normals(int count) {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> normals;
  for (int i = 0; i < count; ++i) {
    normals.push_back(Eigen::Vector3f(normal(random), normal(random), 0.02f + std::abs(normal(random))).normalized());
  }
  return normals;
}

TEST(LightSum, ALambertianUnderAConstantSkyReflectsItsAlbedo) {  // the furnace: with albedo 1 it cannot be seen
  const LightSamples light = light_samples(EnvironmentLight(Image(128, 64, 3, 2.5f)));
  const MicrofacetBrdf white = test::lambert(1);
  for (const Eigen::Vector3f& colour : LightSum(white, light).colours(random_normals(300))) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(colour[k], 2.5f, 2.5e-3f);
  }
}

TEST(LightSum, TheLobesOfADsbrdfAreSummedAsItsValuesAre) {
  const LightSamples light = noisy_light(32, 16);
  for (const auto& [kappa, gamma, first] : {std::tuple(0.5, 20.0, 0.3), {3.0, 900.0, -1.5}, {6.0, 40000.0, 4.0}}) {
    const Dsbrdf material = test::glossy(kappa, gamma, first);
    const LightSum fast(material, light);
    const Plain plain(material);
    const LightSum slow(plain, light);
    for (const Eigen::Vector3f& normal : random_normals(50)) {
      const Eigen::Vector3f a = fast.colour(normal), b = slow.colour(normal);
      EXPECT_LT((a - b).norm(), 2e-4f * b.norm()) << normal.transpose() << " gamma " << gamma;
    }
  }
}

// 2 pi sum of kappa^n / (n! (gamma n + 1)) is the integral of a lobe over half-vectors; over directions of light at the
// pole of the view, dw_i = 4 cos(theta_d) dw_h, and n = v makes theta_h = theta_d.
TEST(LightSum, MeetsAnIntegralOfOneLobe) {
  DsbrdfCoefficients coefficients;
  const double kappa = 0.8, gamma = 25;
  for (int channel = 0; channel < 3; ++channel) {
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      const int from = channel * dsbrdf_channel_size;
      coefficients.segment<spline_size>(from + curve_offset(lobe, DsbrdfCurve::kappa))
          .setConstant(lobe == 2 ? std::log(kappa) : -40);
      coefficients.segment<spline_size>(from + curve_offset(lobe, DsbrdfCurve::gamma)).setConstant(std::log(gamma));
    }
  }
  // Integral of expm1(kappa u^gamma) 4 u (2 u^2 - 1) over the hemisphere of h with n.l = 2 u^2 - 1 > 0, where the lobe
  // is: power series, term n: kappa^n / n! * 2 pi * integral over u of u^(gamma n) (8 u^3 - 4 u).
  double expected = 0, factor = 1;
  const double low = std::sqrt(0.5);
  for (int n = 1; n < 40; ++n) {
    factor *= kappa / n;
    const double a = gamma * n + 4, b = gamma * n + 2;
    expected += factor * 2 * std::numbers::pi * (8 * (1 - std::pow(low, a)) / a - 4 * (1 - std::pow(low, b)) / b);
  }
  const Dsbrdf material(coefficients);
  const LightSamples light = light_samples(EnvironmentLight(Image(512, 256, 3, 1)));
  EXPECT_NEAR(LightSum(material, light).colour(Eigen::Vector3f::UnitZ())[1] / expected, 1, 1e-3);
}

TEST(LightSum, LightThatDoesNotArriveIsNotCounted) {
  const LightSamples light = noisy_light(16, 8);
  const Dsbrdf material = test::glossy(1, 50);
  const Plain plain(material);
  const Eigen::Vector3f normal = Eigen::Vector3f(0.3f, 0.2f, 0.9f).normalized();
  for (const Brdf* each : {static_cast<const Brdf*>(&material), static_cast<const Brdf*>(&plain)}) {
    const LightSum sum(*each, light);
    Eigen::ArrayXf some = Eigen::ArrayXf::Zero(light.size()), rest;
    for (Eigen::Index i = 0; i < some.size(); i += 3) some[i] = 1;
    rest = 1 - some;
    const Eigen::Vector3f both = sum.colour(normal, some.data()) + sum.colour(normal, rest.data());
    EXPECT_LT((both - sum.colour(normal)).norm(), 1e-5f * both.norm());
    EXPECT_EQ(sum.colour(normal, Eigen::ArrayXf::Zero(light.size()).eval().data()).norm(), 0);
  }
}

TEST(ShadingFrame, KeepsAnglesToNormalAndViewer) {
  for (Eigen::Vector3f normal : random_normals(40)) {
    const ShadingFrame frame(normal);
    EXPECT_LT((frame.local(Eigen::Vector3f::UnitZ()) - frame.to_viewer).norm(), 1e-4f);
    EXPECT_LT((frame.local(normal) - Eigen::Vector3f::UnitZ()).norm(), 1e-5f);
    const Eigen::Vector3f light = Eigen::Vector3f(0.2f, -0.5f, 0.7f).normalized();
    EXPECT_NEAR(frame.local(light).norm(), 1, 1e-5f);
    EXPECT_NEAR(frame.local(light).dot(frame.to_viewer), light.z(), 1e-4f);
  }
  EXPECT_EQ(ShadingFrame(Eigen::Vector3f::UnitZ()).to_viewer.z(), 1);
}

TEST(HalfwayTable, PlacesAreKnotsAndBetweenThemLinear) {
  for (int place = 0; place < HalfwayTable::places; ++place) {
    EXPECT_NEAR(HalfwayTable::place(float8::all(HalfwayTable::knot(place)))[3], place,
                0.02f + (place > 545 ? 1.0f : 0.0f))
        << place;
    if (place > 0) {
      EXPECT_GT(HalfwayTable::knot(place), HalfwayTable::knot(place - 1));
    }
  }
}

TEST(HalfwayTable, GivesTheMaterialsValues) {
  for (const auto& [kappa, gamma, first] : {std::tuple(0.5, 20.0, 0.3), {3.0, 900.0, -1.5}, {6.0, 40000.0, 4.0}}) {
    const Dsbrdf material = test::glossy(kappa, gamma, first);
    const HalfwayTable table(material);
    HalfwayTable::Row row;
    double worst = 0;
    for (double theta_d = 0.003; theta_d < std::numbers::pi / 2; theta_d += 0.05) {
      table.row(theta_d, {1, 2, 0.5f}, row);
      for (double s = 1e-7; s < 0.98; s *= 1.03) {
        const float place = HalfwayTable::place(float8::all(static_cast<float>(s)))[0];
        const auto whole = static_cast<std::size_t>(place);
        const double part = static_cast<double>(place) - static_cast<double>(whole);
        const double truth = material.lobes(theta_d).value(1 - s)[1];
        const double found =
            (1 - part) * static_cast<double>(row[4 * whole + 1]) + part * static_cast<double>(row[4 * whole + 5]);
        worst = std::max(worst, std::abs(found / (2 * truth) - 1));
      }
    }
    // The first lobe of cloth, near the bound of its exponent, grows by a third from knot to knot.
    EXPECT_LT(worst, first < 0 ? 0.03 : 0.005) << gamma;
  }
}

TEST(HalfwayTable, KeepsToTheShippedMaterialsBetweenItsRows) {
  constexpr double row_angle = std::numbers::pi / 2 / (HalfwayTable::rows - 1), last = 85 * std::numbers::pi / 180;
  for (const std::string& name : shipped_materials()) {
    const Dsbrdf material = shipped_material(name).brdf;
    const HalfwayTable table(material);
    double sum = 0, count = 0;
    for (double theta_d = row_angle / 2; theta_d < last; theta_d += row_angle) {
      for (int place = 0; place < HalfwayTable::places; place += 20) {  // at knots: no error along the row
        const float s = HalfwayTable::knot(place);
        const double truth = material.lobes(theta_d).value(1 - static_cast<double>(s))[1];
        const double found = static_cast<double>(table.value(static_cast<float>(std::cos(theta_d)), s)[1]);
        sum += std::abs(found - truth) / (std::abs(truth) + 1e-3), ++count;
      }
    }
    EXPECT_LT(sum / count, 1e-3) << name;
  }
}

}  // namespace
}  // namespace partwise
