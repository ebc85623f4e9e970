#include "partwise/appearance/material/microfacet_brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "partwise/appearance/material/microfacet_lobe.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double kPi = std::numbers::pi;

// Smith's shadowing and masking of GGX over 4 cos_i cos_o (Heitz 2014).
double ggx_visibility(double cos_i, double cos_o, double roughness) {
  const double a2 = roughness * roughness;
  const double i = cos_o * std::sqrt(a2 + (1 - a2) * cos_i * cos_i),
               o = cos_i * std::sqrt(a2 + (1 - a2) * cos_o * cos_o);
  return 0.5 / (i + o);
}

double groove_visibility(double cos_i, double cos_o, double cos_h, double cos_d) {
  return std::min({1.0, 2 * cos_h * cos_i / cos_d, 2 * cos_h * cos_o / cos_d}) / (4 * cos_i * cos_o);
}

}  // namespace

double beckmann_distribution(double cos_theta_h, double roughness) {
  const double c2 = cos_theta_h * cos_theta_h, a2 = roughness * roughness;
  return c2 > 0 ? std::exp((c2 - 1) / (a2 * c2)) / (kPi * a2 * c2 * c2) : 0;
}

double ggx_distribution(double cos_theta_h, double roughness) {
  const double c2 = cos_theta_h * cos_theta_h, a2 = roughness * roughness;
  const double base = (1 - c2) + a2 * c2;
  return a2 / (kPi * base * base);
}

double lobe_value(LobeShape shape, double roughness, const LobeAngles& at) {
  switch (shape) {
    case LobeShape::blinn_phong: {
      const double n = std::max(2 / (roughness * roughness) - 2, 0.0);
      return (n + 8) / (8 * kPi) * std::pow(at.cos_h, n);
    }
    case LobeShape::cook_torrance:
      return beckmann_distribution(at.cos_h, roughness) * groove_visibility(at.cos_i, at.cos_o, at.cos_h, at.cos_d);
    case LobeShape::ggx:
      return ggx_distribution(at.cos_h, roughness) * ggx_visibility(at.cos_i, at.cos_o, roughness);
  }
  return 0;
}

double schlick_share(LobeShape shape, double cos_d) {
  return shape == LobeShape::blinn_phong ? 0 : std::pow(1 - cos_d, 5);
}

MicrofacetBrdf::MicrofacetBrdf(const Eigen::Vector3d& diffuse, LobeShape shape, std::vector<MicrofacetLobe> lobes)
    : diffuse_(diffuse), shape_(shape), lobes_(std::move(lobes)) {
  for (const MicrofacetLobe& lobe : lobes_) {
    PARTWISE_CHECK(lobe.roughness, >, 0);
    PARTWISE_CHECK(lobe.roughness, <=, 1);
  }
}

Eigen::Vector3f MicrofacetBrdf::operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const {
  if (!(to_light.z() > 0 && to_viewer.z() > 0)) return Eigen::Vector3f::Zero();
  const HalfAngles angles = half_angles(to_light.cast<double>(), to_viewer.cast<double>());
  const LobeAngles at{to_light.z(), to_viewer.z(), std::cos(angles.theta_h), std::cos(angles.theta_d)};
  const double grazing = schlick_share(shape_, at.cos_d);
  Eigen::Vector3d sum = diffuse_ / kPi;
  for (const MicrofacetLobe& lobe : lobes_) {
    const Eigen::Vector3d reflectance = lobe.reflectance.array() + (1 - lobe.reflectance.array()) * grazing;
    sum += reflectance * lobe_value(shape_, lobe.roughness, at);
  }
  return sum.cast<float>();
}

}  // namespace partwise
