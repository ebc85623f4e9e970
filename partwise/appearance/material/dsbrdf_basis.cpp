#include "partwise/appearance/material/dsbrdf_basis.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <limits>

#include "partwise/appearance/material/dsbrdf_loss.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

using Metric = Eigen::Matrix<double, dsbrdf_size, dsbrdf_size>;

// Unwhitened psi far from what the basis was made from are unlikely: one squared deviation weighs as much as this
// share of a bin.
constexpr double kRarity = 0.02;

// Means over phi_d of directions above the horizon hardly differ from those of phi_d = pi / 2.
HalfAngleArray cosines() {
  HalfAngleArray result;
  for (int row = 0; row < half_angle_rows; ++row) {
    for (int column = 0; column < half_angle_columns; ++column) {
      result(row, column) = std::cos(theta_h_of_row(row)) * std::cos(theta_d_of_column(column));
    }
  }
  return result;
}

// J^T W J of the material's own samples. The loss has its prior in it, which keeps the metric from being singular.
Metric metric_of(const Dsbrdf& material) {
  static const HalfAngleArray cosine = cosines();
  std::array<HalfAngleArray, 3> values;
  for (int column = 0; column < half_angle_columns; ++column) {
    const DsbrdfLobes lobes = material.lobes(theta_d_of_column(column));
    for (int row = 0; row < half_angle_rows; ++row) {
      const Eigen::Vector3d value = lobes.value(std::cos(theta_h_of_row(row)));
      for (int channel = 0; channel < 3; ++channel) values[channel](row, column) = value[channel];
    }
  }
  Metric result = Metric::Zero();
  for (int channel = 0; channel < 3; ++channel) {
    const int at = channel * dsbrdf_channel_size;
    result.block<dsbrdf_channel_size, dsbrdf_channel_size>(at, at) =
        DsbrdfLoss(values[channel], cosine)(material.coefficients().segment<dsbrdf_channel_size>(at), true).hessian;
  }
  return result;
}

}  // namespace

DsbrdfBasis DsbrdfBasis::first(int count) const {
  PARTWISE_CHECK(count, <=, size());
  return {mean, components.leftCols(count), projection.topRows(count)};
}

Dsbrdf DsbrdfBasis::material(const Eigen::VectorXd& psi) const {
  const DsbrdfCoefficients coefficients = mean + components * psi;
  return Dsbrdf(
      coefficients.cwiseMax(least_coefficients().replicate<3, 1>()).cwiseMin(largest_coefficients().replicate<3, 1>()));
}

Eigen::VectorXd DsbrdfBasis::project(const Dsbrdf& material) const {
  return projection * (material.coefficients() - mean);
}

DsbrdfBasis principal_components(const std::vector<Dsbrdf>& materials, int components) {
  const auto count = static_cast<Eigen::Index>(materials.size());
  PARTWISE_CHECK(count, >=, 2);
  PARTWISE_CHECK(components, <=, count - 1);
  std::vector<Metric> metrics(materials.size());
  tbb::parallel_for(std::size_t{0}, materials.size(), [&](std::size_t i) { metrics[i] = metric_of(materials[i]); });
  Metric metric = Metric::Zero();
  Eigen::Matrix<double, dsbrdf_size, Eigen::Dynamic> coefficients(dsbrdf_size, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    metric += metrics[static_cast<std::size_t>(i)] / static_cast<double>(count);
    coefficients.col(i) = materials[static_cast<std::size_t>(i)].coefficients();
  }
  DsbrdfBasis basis;
  basis.mean = coefficients.rowwise().mean();
  const Eigen::LLT<Metric> root(metric);  // metric = L L^T, and L^T takes it to the plain one
  const Eigen::MatrixXd centred = root.matrixU() * Eigen::MatrixXd(coefficients.colwise() - basis.mean);
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinU);
  const Eigen::VectorXd deviations =
      (svd.singularValues().head(components) / std::sqrt(static_cast<double>(count - 1))).cwiseMax(1e-12);
  const Eigen::MatrixXd axes = svd.matrixU().leftCols(components);
  basis.components = root.matrixU().solve(Eigen::MatrixXd(axes * deviations.asDiagonal()));
  basis.projection = deviations.cwiseInverse().asDiagonal() * axes.transpose() * Eigen::MatrixXd(root.matrixU());
  return basis;
}

Eigen::VectorXd fit_in_basis(const DsbrdfBasis& basis, const HalfAngleTable& measured, const Dsbrdf& fit) {
  std::vector<DsbrdfLoss> losses;
  losses.reserve(3);
  for (int channel = 0; channel < 3; ++channel) losses.emplace_back(measured.values[channel], measured.cosine);
  const auto problem = [&](const Eigen::VectorXd& psi, bool derivatives) {
    NormalEquations sum{0.5 * kRarity * psi.squaredNorm(), kRarity * Eigen::MatrixXd::Identity(psi.size(), psi.size()),
                        kRarity * psi};
    const DsbrdfCoefficients coefficients = basis.mean + basis.components * psi;
    for (int channel = 0; channel < 3; ++channel) {
      const int at = channel * dsbrdf_channel_size;
      const NormalEquations own = losses[channel](coefficients.segment<dsbrdf_channel_size>(at), derivatives);
      sum.cost += own.cost;
      if (!derivatives) continue;
      const auto rows = basis.components.middleRows<dsbrdf_channel_size>(at);
      sum.gradient += rows.transpose() * own.gradient;
      sum.hessian += rows.transpose() * own.hessian * rows;
    }
    return sum;
  };
  const Eigen::VectorXd unbounded = Eigen::VectorXd::Constant(basis.size(), std::numeric_limits<double>::infinity());
  return minimise(problem, basis.project(fit), -unbounded, unbounded).variables;
}

}  // namespace partwise
