#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "partwise/appearance/material/dsbrdf_loss.h"
#include "partwise/appearance/material/levenberg_marquardt.h"
#include "partwise/appearance/material/microfacet_lobe.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr int kPhiSamples = 8;  // over half of [0, pi), for the lobes are reciprocal
constexpr double kLeastColour = 1e-6, kLargestColour = 10, kLeastRoughness = 1e-3;
constexpr double kStep = 1e-4;  // of the derivative to log(roughness)
const std::array<std::vector<double>, 4> kRoughness = {
    {{0.6, 0.3, 0.1}, {0.3, 0.1, 0.03}, {0.1, 0.03, 0.01}, {0.9, 0.2, 0.05}}};  // starts, by lobe

// Variables: logarithms of diffuse (3), and for each lobe of its roughness and its reflectance (3).
Eigen::Index first_of(int lobe) { return 3 + 4 * lobe; }

class Problem {
 public:
  Problem(const HalfAngleTable& measured, LobeShape shape, int lobes)
      : measured_(measured), shape_(shape), lobes_(lobes) {
    for (int channel = 0; channel < 3; ++channel) {
      weights_[channel] = loss_weights(measured.values[channel], measured.cosine);
      targets_[channel] = (measured.values[channel] * measured.cosine + log_floor).log();
    }
  }

  NormalEquations operator()(const Eigen::VectorXd& x, bool derivatives) const {
    NormalEquations sum{0, Eigen::MatrixXd::Zero(x.size(), x.size()), Eigen::VectorXd::Zero(x.size())};
    std::vector<HalfAngleArray> lobes, slopes;  // of the lobes' values, to log(roughness)
    for (int lobe = 0; lobe < lobes_; ++lobe) {
      const double log_roughness = x[first_of(lobe)];
      lobes.push_back(mean_lobe(std::exp(log_roughness)));
      if (!derivatives) continue;
      const double before = log_roughness - kStep;  // downwards, for 1 is the largest
      slopes.push_back((lobes.back() - mean_lobe(std::exp(before))) / kStep);
    }
    for (int channel = 0; channel < 3; ++channel) add_channel(channel, x, lobes, slopes, derivatives, sum);
    return sum;
  }

 private:
  // The mean over phi_d of one lobe of reflectance 1, over the directions above the horizon.
  HalfAngleArray mean_lobe(double roughness) const {
    HalfAngleArray result = HalfAngleArray::Zero();
    for (int row = 0; row < half_angle_rows; ++row) {
      for (int column = 0; column < half_angle_columns; ++column) {
        if (!(measured_.cosine(row, column) > 0)) continue;
        const double h = theta_h_of_row(row), d = theta_d_of_column(column);
        const double along = std::cos(h) * std::cos(d), across = std::sin(h) * std::sin(d);
        double sum = 0;
        int count = 0;
        for (int sample = 0; sample < kPhiSamples; ++sample) {
          const double tilt = across * std::cos((sample + 0.5) / kPhiSamples * std::numbers::pi / 2);
          // Near the horizon only directions across the plane of incidence are left: take those of phi_d = pi / 2.
          if (along - tilt <= 0) continue;
          sum += lobe_value(shape_, roughness, {along - tilt, along + tilt, std::cos(h), std::cos(d)});
          ++count;
        }
        result(row, column) =
            count ? sum / count : lobe_value(shape_, roughness, {along, along, std::cos(h), std::cos(d)});
      }
    }
    return result;
  }

  void add_channel(int channel, const Eigen::VectorXd& x, const std::vector<HalfAngleArray>& lobes,
                   const std::vector<HalfAngleArray>& slopes, bool derivatives, NormalEquations& sum) const {
    std::vector<std::pair<Eigen::Index, HalfAngleArray>> jacobian;  // of the value, by variable
    HalfAngleArray value = HalfAngleArray::Constant(std::exp(x[channel]) / std::numbers::pi);
    if (derivatives) jacobian.emplace_back(channel, value);
    for (int lobe = 0; lobe < lobes_; ++lobe) {
      const Eigen::Index first = first_of(lobe);
      const double reflectance = std::exp(x[first + 1 + channel]);
      HalfAngleArray schlick;
      for (int column = 0; column < half_angle_columns; ++column) {
        schlick.col(column).setConstant(schlick_share(shape_, std::cos(theta_d_of_column(column))));
      }
      const HalfAngleArray reflected = reflectance + (1 - reflectance) * schlick;
      value += reflected * lobes[lobe];
      if (!derivatives) continue;
      jacobian.emplace_back(first, reflected * slopes[lobe]);
      jacobian.emplace_back(first + 1 + channel, reflectance * (1 - schlick) * lobes[lobe]);
    }
    const HalfAngleArray light = (value * measured_.cosine + log_floor).max(1e-9);
    const HalfAngleArray residual = light.log() - targets_[channel];
    const HalfAngleArray root = (1 + (residual / robust_delta).square()).sqrt();
    sum.cost += (weights_[channel] * (root - 1)).sum() * robust_delta * robust_delta;
    const HalfAngleArray weight = weights_[channel] / root, chain = measured_.cosine / light;
    for (auto& [i, slope] : jacobian) slope *= chain;
    for (const auto& [i, a] : jacobian) {
      sum.gradient[i] += (weight * a * residual).sum();
      for (const auto& [j, b] : jacobian) sum.hessian(i, j) += (weight * a * b).sum();
    }
  }

  const HalfAngleTable& measured_;
  LobeShape shape_;
  int lobes_;
  std::array<HalfAngleArray, 3> weights_, targets_;
};

// Half of the level at 50 degrees is diffuse; lobes begin alike, as strong as a plastic's.
Eigen::VectorXd start_from(const HalfAngleTable& measured, int lobes, std::size_t start) {
  constexpr int row = 67, column = 15;
  Eigen::VectorXd x(3 + 4 * lobes);
  for (int channel = 0; channel < 3; ++channel) {
    x[channel] = std::log(std::max(std::numbers::pi / 2 * measured.values[channel](row, column), 1e-4));
  }
  for (int lobe = 0; lobe < lobes; ++lobe) {
    const double roughness = kRoughness[start][std::min<std::size_t>(static_cast<std::size_t>(lobe), 2)];
    x[first_of(lobe)] = std::log(roughness / (1 + std::max(lobe - 2, 0)));
    x.segment<3>(first_of(lobe) + 1).setConstant(std::log(0.05));
  }
  return x;
}

Eigen::VectorXd with_weak_lobe(const MicrofacetBrdf& brdf, double roughness) {
  const int lobes = static_cast<int>(brdf.lobes().size());
  Eigen::VectorXd x(3 + 4 * (lobes + 1));
  x.head<3>() = brdf.diffuse().array().log();
  for (int lobe = 0; lobe < lobes; ++lobe) {
    const MicrofacetLobe& own = brdf.lobes()[static_cast<std::size_t>(lobe)];
    x[first_of(lobe)] = std::log(own.roughness);
    x.segment<3>(first_of(lobe) + 1) = own.reflectance.array().log();
  }
  x[first_of(lobes)] = std::log(roughness);
  x.segment<3>(first_of(lobes) + 1).setConstant(std::log(1e-3));
  return x;
}

}  // namespace

MicrofacetBrdf fit_microfacets(const HalfAngleTable& measured, LobeShape shape, int lobes) {
  if (!(measured.cosine > 0).any()) {
    throw InputError("material", "nothing was measured above the horizon", "give a material that reflects");
  }
  Eigen::VectorXd least = Eigen::VectorXd::Constant(3 + 4 * lobes, std::log(kLeastColour));
  Eigen::VectorXd largest = Eigen::VectorXd::Constant(3 + 4 * lobes, std::log(kLargestColour));
  for (int lobe = 0; lobe < lobes; ++lobe) {
    least[first_of(lobe)] = std::log(kLeastRoughness);
    largest[first_of(lobe)] = 0;
  }
  std::vector<Eigen::VectorXd> starts;
  for (std::size_t i = 0; i < (lobes ? kRoughness.size() : 1); ++i) starts.push_back(start_from(measured, lobes, i));
  // The best with one lobe less, and a weak one: more lobes are never worse.
  if (lobes > 1) {
    const MicrofacetBrdf fewer = fit_microfacets(measured, shape, lobes - 1);
    for (const double roughness : {0.3, 0.03}) starts.push_back(with_weak_lobe(fewer, roughness));
  }
  const Problem problem(measured, shape, lobes);
  std::vector<Minimum> found(starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(),
                    [&](std::size_t i) { found[i] = minimise(problem, starts[i], least, largest); });
  const Minimum& best = *std::ranges::min_element(found, {}, &Minimum::cost);
  const Eigen::VectorXd values = best.variables.array().exp();
  std::vector<MicrofacetLobe> result;
  result.reserve(static_cast<std::size_t>(lobes));
  for (int lobe = 0; lobe < lobes; ++lobe) {
    result.push_back({std::min(values[first_of(lobe)], 1.0), values.segment<3>(first_of(lobe) + 1)});
  }
  return MicrofacetBrdf(values.head<3>(), shape, std::move(result));
}

}  // namespace partwise
