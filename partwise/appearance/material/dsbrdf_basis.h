// Few numbers for a material: functional principal components of the curves of many (Lombardi and Nishino 2012,
// "Reflectance and natural illumination from a single image"; 32 components in the dissertation, chapter 4).
//
// All 36 curves of a material together are their mean plus a sum of psi_j times the j-th component. The components are
// orthogonal, and ordered, not in the coefficients, of which many say nothing about the look of a material, but in the
// metric of sampled logarithms of f cos: the mean over the materials of J^T W J, where J are the derivatives of the
// samples to the coefficients and W the weights of the fit. psi is in standard deviations over those materials.
//
// Errors: CheckFailed for fewer than two materials, or for more components than their number less one.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/material/half_angle_table.h"

namespace partwise {

inline constexpr int default_components = 32;

struct DsbrdfBasis {
  DsbrdfCoefficients mean;
  Eigen::Matrix<double, dsbrdf_size, Eigen::Dynamic> components;  // a column each
  Eigen::Matrix<double, Eigen::Dynamic, dsbrdf_size> projection;  // projection * components is the identity

  int size() const { return static_cast<int>(components.cols()); }
  DsbrdfBasis first(int count) const;

  // The material of these numbers, its coefficients moved into the range of fits.
  Dsbrdf material(const Eigen::VectorXd& psi) const;
  // The numbers nearest to a material in the metric.
  Eigen::VectorXd project(const Dsbrdf& material) const;
};

DsbrdfBasis principal_components(const std::vector<Dsbrdf>& materials, int components = default_components);

// The numbers whose material is nearest to a measured one by the loss of fit_dsbrdf: Levenberg-Marquardt from the
// projection of `fit`, which is the fit with all coefficients.
Eigen::VectorXd fit_in_basis(const DsbrdfBasis& basis, const HalfAngleTable& measured, const Dsbrdf& fit);

}  // namespace partwise
