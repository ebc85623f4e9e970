// Least squares by the method of Levenberg and Marquardt (Marquardt 1963), within bounds: variables that a step would
// push through their bound rest there while the others are solved for.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace partwise {

// The cost and, to first order in the residuals, its derivatives: half the sum of squares, J^T J and J^T r.
struct NormalEquations {
  double cost = 0;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
};

struct LeastSquaresSettings {
  int iterations = 100;       // at most
  double convergence = 1e-5;  // stop when a step gains less than this share of the cost
};

// `derivatives` says whether hessian and gradient are wanted.
using LeastSquares = std::function<NormalEquations(const Eigen::VectorXd& variables, bool derivatives)>;

struct Minimum {
  Eigen::VectorXd variables;
  double cost = 0;
};

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start, const Eigen::VectorXd& least,
                 const Eigen::VectorXd& largest, const LeastSquaresSettings& settings = {});

}  // namespace partwise
