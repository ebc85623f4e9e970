#include "partwise/appearance/material/levenberg_marquardt.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace partwise {
namespace {

constexpr double kLeastDamping = 1e-9, kLargestDamping = 1e9;

// Solves for the free variables alone, each damped in its own scale; the others do not move.
Eigen::VectorXd damped_step(const NormalEquations& normal, const Eigen::Array<bool, Eigen::Dynamic, 1>& free,
                            double damping) {
  Eigen::MatrixXd matrix = normal.hessian;
  Eigen::VectorXd right = -normal.gradient;
  const double scale = std::max(normal.hessian.diagonal().maxCoeff(), 1e-300);
  for (Eigen::Index i = 0; i < right.size(); ++i) {
    if (free[i]) {
      matrix(i, i) += damping * std::max(normal.hessian(i, i), 1e-9 * scale);
    } else {
      matrix.row(i).setZero();
      matrix.col(i).setZero();
      matrix(i, i) = 1;
      right[i] = 0;
    }
  }
  return matrix.ldlt().solve(right);
}

}  // namespace

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start, const Eigen::VectorXd& least,
                 const Eigen::VectorXd& largest, const LeastSquaresSettings& settings) {
  Eigen::VectorXd variables = start.cwiseMax(least).cwiseMin(largest);
  NormalEquations now = problem(variables, true);
  double damping = 1e-2;
  for (int iteration = 0; iteration < settings.iterations && damping < kLargestDamping; ++iteration) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> free =
        !((variables.array() <= least.array() && now.gradient.array() > 0) ||
          (variables.array() >= largest.array() && now.gradient.array() < 0));
    const Eigen::VectorXd step = damped_step(now, free, damping);
    const Eigen::VectorXd next = (variables + step).cwiseMax(least).cwiseMin(largest);
    const double cost = next.allFinite() ? problem(next, false).cost : now.cost;
    if (!(cost < now.cost)) {
      damping *= 4;
      continue;
    }
    const bool settled = now.cost - cost < settings.convergence * now.cost;
    variables = next;
    now = problem(variables, true);
    if (settled) break;
    damping = std::max(damping / 5, kLeastDamping);
  }
  return {variables, now.cost};
}

}  // namespace partwise
