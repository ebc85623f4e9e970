// Random materials, lights and normals that the tests of this room share. Tests and benchmarks only; not installed.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "partwise/learning/differentiable_sum.h"

namespace partwise::test {

// Within the range of fits, with a first lobe that rises towards grazing half-vectors when `cloth`.
inline Coefficients<double> random_material(std::mt19937& random, bool cloth) {
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Coefficients<double> material;
  for (int channel = 0; channel < 3; ++channel) {
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      const int from = channel * dsbrdf_channel_size;
      for (int k = 0; k < spline_size; ++k) {
        const double sharpness = lobe == 1 ? within(1, 3) : within(4, 6);
        material[from + curve_offset(lobe, DsbrdfCurve::kappa) + k] = within(-2.5, 0.5);
        material[from + curve_offset(lobe, DsbrdfCurve::gamma) + k] =
            lobe > 0 ? sharpness : (cloth ? within(-2, -0.5) : within(0.2, 3));
      }
    }
  }
  return material;
}

// Some pixels dark, few very bright.
inline Planes<double> random_radiance(std::mt19937& random, int pixels) {
  std::exponential_distribution<double> value(1);
  Planes<double> radiance(pixels, 3);
  for (double& each : radiance.reshaped()) each = value(random);
  for (int i = 0; i < pixels; i += 7) radiance.row(i).setZero();
  radiance.row(pixels / 3) *= 30;
  return radiance;
}

// Of the visible hemisphere; the first four are special: background, straight on, grazing, turned away.
inline Planes<double> random_normals(std::mt19937& random, int count) {
  std::normal_distribution<double> value;
  Planes<double> normals(count, 3);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d normal(value(random), value(random), 0.01 + std::abs(value(random)));
    normals.row(i) = normal.normalized().transpose().array();
  }
  normals.row(0).setZero();
  if (count > 1) normals.row(1) << 0, 0, 1;
  if (count > 2) normals.row(2) = Eigen::RowVector3d(-0.6, 0.8, 0.004).normalized().array();
  if (count > 3) normals.row(3) = Eigen::RowVector3d(0.7, 0.6, -0.15).normalized().array();
  return normals;
}

// Central differences of `function`, a number, at every entry of `values`, which it reads: within 1e-5 of the gradient,
// relatively; entries that are nothing beside the largest may differ by 1e-8 of that.
template <typename Values, typename Gradient, typename Function>
void expect_gradient(Values& values, const Gradient& gradient, const Function& function) {
  ASSERT_EQ(values.size(), gradient.size());
  constexpr double step = 1e-6;
  const double largest = gradient.abs().maxCoeff();
  ASSERT_GT(largest, 0);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    double& entry = values.reshaped()[i];
    const double kept = entry;
    entry = kept + step;
    const double above = function();
    entry = kept - step;
    const double below = function();
    entry = kept;
    const double difference = (above - below) / (2 * step);
    EXPECT_NEAR(gradient.reshaped()[i], difference, 1e-5 * std::abs(difference) + 1e-8 * largest) << "entry " << i;
  }
}

}  // namespace partwise::test
