// The models that others fit to measured materials, to stand beside ours: Lambert alone, or with lobes of Blinn and
// Phong (Blinn 1977), of Cook and Torrance (1982) with Beckmann's distribution, or of GGX (Walter, Marschner, Li,
// Torrance 2007), one to any number of them.
//
//   f_c = diffuse_c / pi + sum over lobes of (R_c + (1 - R_c) (1 - cos theta_d)^5) D(theta_h) G / (4 cos_i cos_o)
//
// with Schlick's reflectance; G is that of V-shaped grooves for Cook and Torrance and Smith's, correlated in height,
// for GGX. A lobe of Blinn and Phong is R_c (n + 8) / (8 pi) cos(theta_h)^n, with n = 2 / roughness^2 - 2.
//
// Linear RGB in 1/sr. Errors: CheckFailed for a roughness outside (0, 1]; InputError from fits to what has no values.
#pragma once

#include <vector>

#include "partwise/appearance/material/brdf.h"
#include "partwise/appearance/material/half_angle_table.h"

namespace partwise {

enum class LobeShape { blinn_phong, cook_torrance, ggx };

struct MicrofacetLobe {
  double roughness = 0.3;                                         // alpha, the slope's scale; in (0, 1]
  Eigen::Vector3d reflectance = Eigen::Vector3d::Constant(0.04);  // at normal incidence
};

class MicrofacetBrdf final : public Brdf {
 public:
  explicit MicrofacetBrdf(const Eigen::Vector3d& diffuse, LobeShape shape = LobeShape::ggx,
                          std::vector<MicrofacetLobe> lobes = {});

  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override;

  const Eigen::Vector3d& diffuse() const { return diffuse_; }
  const std::vector<MicrofacetLobe>& lobes() const { return lobes_; }

 private:
  Eigen::Vector3d diffuse_;
  LobeShape shape_;
  std::vector<MicrofacetLobe> lobes_;
};

// Share of the normals' distribution per solid angle: its integral with cos(theta_h) over the hemisphere is 1 for
// Beckmann and GGX.
double beckmann_distribution(double cos_theta_h, double roughness);
double ggx_distribution(double cos_theta_h, double roughness);

// The nearest by the loss that fit_dsbrdf has, the best of several starts; 0 lobes is Lambert.
MicrofacetBrdf fit_microfacets(const HalfAngleTable& measured, LobeShape shape, int lobes);

}  // namespace partwise
