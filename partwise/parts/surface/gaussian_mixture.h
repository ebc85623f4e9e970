// A mixture of Gaussians fitted to points by expectation maximisation (Dempster, Laird, Rubin 1977), as the soft
// clustering of faces uses it (section 2.2.4.2).
//
// It starts from k-means (Lloyd 1982, seeded as k-means++, Arthur and Vassilvitskii 2007), the best of several
// restarts, and then maximises the weighted likelihood. Deviations are those of each coordinate by itself (diagonal
// covariance). Deterministic for a seed. Time O(points x components x iterations).
// Errors: InputError for settings out of range or a value that is not finite.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace partwise {

struct MixtureSettings {
  int components = 5;
  int restarts = 15;              // of k-means++
  int iterations = 50;            // of the maximisation, at most
  double convergence = 1e-4;      // stop when the mean log-likelihood gains less
  double least_deviation = 1e-3;  // in units of the points; keeps equal points from becoming infinitely likely
  std::uint64_t seed = 0;
};

struct GaussianMixture {
  Eigen::MatrixXd means;       // components x d, ascending by the first coordinate
  Eigen::MatrixXd deviations;  // components x d
  Eigen::VectorXd shares;      // of the components, they sum to 1
  double log_likelihood = 0;   // mean over the points

  // points x components: the logarithm of share times density.
  Eigen::MatrixXd log_densities(const Eigen::MatrixXd& points) const;
  // points x components: how probable it is that the point comes from the component; rows sum to 1.
  Eigen::MatrixXd responsibilities(const Eigen::MatrixXd& points) const;
};

// points: n x d. weights: one a point, not negative, or empty for equal ones. Fewer distinct points than components
// give fewer components.
GaussianMixture fit_mixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights,
                            const MixtureSettings& settings = {});

}  // namespace partwise
