#include "partwise/parts/surface/gaussian_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr int kLloydRounds = 20;
constexpr Eigen::Index kSeedPoints = 2000;  // restarts are tried on about so many of the points, evenly spaced

void check(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, const MixtureSettings& settings) {
  if (settings.components < 1) {
    throw InputError("clusters", fmt::format("{} is no number of clusters", settings.components), "give 1 or more");
  }
  if (settings.restarts < 1) {
    throw InputError("restarts", fmt::format("{} is no number of restarts", settings.restarts), "give 1 or more");
  }
  if (points.rows() == 0) throw InputError("points", "there are none", "give at least one");
  if (!points.allFinite()) throw InputError("points", "a value is not finite", "fill missing values in first");
  if (weights.size() != 0 && (weights.size() != points.rows() || !(weights.minCoeff() >= 0) || !(weights.sum() > 0))) {
    throw InputError("weights", "they do not fit the points", "give one a point, none negative and not all zero");
  }
}

// Index of the first entry whose cumulated value exceeds a random share of the sum; -1 if the sum is zero.
Eigen::Index draw(const Eigen::VectorXd& chances, std::mt19937_64& random) {
  const double share = static_cast<double>(random() >> 11) * 0x1p-53 * chances.sum();
  double sum = 0;
  Eigen::Index last = -1;
  for (Eigen::Index i = 0; i < chances.size(); ++i) {
    if (!(chances[i] > 0)) continue;
    sum += chances[i];
    last = i;
    if (sum > share) return i;
  }
  return last;
}

struct Grouping {
  Eigen::MatrixXd centres;
  std::vector<int> group;
  double cost = std::numeric_limits<double>::infinity();
};

Eigen::MatrixXd spread_centres(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, int count,
                               std::mt19937_64& random) {
  Eigen::MatrixXd centres(count, points.cols());
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(points.rows(), std::numeric_limits<double>::infinity());
  int found = 0;
  for (; found < count; ++found) {
    const Eigen::Index next = found == 0 ? draw(weights, random) : draw(nearest.cwiseProduct(weights), random);
    if (next < 0) break;  // every point is a centre already
    centres.row(found) = points.row(next);
    nearest = nearest.cwiseMin((points.rowwise() - centres.row(found)).rowwise().squaredNorm());
  }
  return centres.topRows(found);
}

void assign(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, Grouping& grouping) {
  grouping.cost = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index c = 0; c < grouping.centres.rows(); ++c) {
      const double squared = (points.row(i) - grouping.centres.row(c)).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      grouping.group[i] = static_cast<int>(c);
    }
    grouping.cost += weights[i] * least;
  }
}

Grouping lloyd(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, Eigen::MatrixXd centres) {
  Grouping grouping{std::move(centres), std::vector<int>(static_cast<std::size_t>(points.rows()))};
  assign(points, weights, grouping);
  for (int round = 0; round < kLloydRounds; ++round) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(grouping.centres.rows(), points.cols());
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(grouping.centres.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      sums.row(grouping.group[i]) += weights[i] * points.row(i);
      mass[grouping.group[i]] += weights[i];
    }
    for (Eigen::Index c = 0; c < sums.rows(); ++c)
      if (mass[c] > 0) grouping.centres.row(c) = sums.row(c) / mass[c];
    const double before = grouping.cost;
    assign(points, weights, grouping);
    if (!(grouping.cost < before)) break;
  }
  return grouping;
}

Grouping group_points(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, const MixtureSettings& settings) {
  const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / kSeedPoints);
  const auto sample = Eigen::seq(0, points.rows() - 1, step);
  const Eigen::MatrixXd some = points(sample, Eigen::all);
  Eigen::VectorXd some_weights = weights(sample);
  if (!(some_weights.sum() > 0)) some_weights.setOnes();
  std::mt19937_64 random(settings.seed);
  Grouping best;
  for (int restart = 0; restart < settings.restarts; ++restart) {
    Grouping grouping = lloyd(some, some_weights, spread_centres(some, some_weights, settings.components, random));
    if (grouping.cost < best.cost) best = std::move(grouping);
  }
  return step == 1 ? best : lloyd(points, weights, std::move(best.centres));
}

void maximise(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, const Eigen::MatrixXd& responsibilities,
              double least_deviation, GaussianMixture& mixture) {
  const Eigen::MatrixXd weighted = responsibilities.array().colwise() * weights.array();
  const Eigen::VectorXd mass = weighted.colwise().sum();
  mixture.shares = mass / mass.sum();
  for (Eigen::Index c = 0; c < mass.size(); ++c) {
    if (!(mass[c] > 0)) continue;  // A component that nothing belongs to stays where it is, with share 0.
    mixture.means.row(c) = weighted.col(c).transpose() * points / mass[c];
    const Eigen::ArrayXXd difference = points.rowwise() - mixture.means.row(c);
    const Eigen::RowVectorXd variance = weighted.col(c).transpose() * difference.square().matrix() / mass[c];
    mixture.deviations.row(c) = variance.cwiseMax(least_deviation * least_deviation).cwiseSqrt();
  }
}

// Turns logarithms of densities into responsibilities and returns the mean log-likelihood.
double normalise_rows(Eigen::MatrixXd& logs, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (Eigen::Index i = 0; i < logs.rows(); ++i) {
    const double largest = logs.row(i).maxCoeff();
    logs.row(i) = (logs.row(i).array() - largest).exp();
    const double total = logs.row(i).sum();
    logs.row(i) /= total;
    sum += weights[i] * (largest + std::log(total));
  }
  return sum / weights.sum();
}

void sort_components(GaussianMixture& mixture) {
  std::vector<int> order(static_cast<std::size_t>(mixture.shares.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return mixture.means(a, 0) < mixture.means(b, 0); });
  mixture.means = Eigen::MatrixXd(mixture.means(order, Eigen::all));
  mixture.deviations = Eigen::MatrixXd(mixture.deviations(order, Eigen::all));
  mixture.shares = Eigen::VectorXd(mixture.shares(order));
}

}  // namespace

Eigen::MatrixXd GaussianMixture::log_densities(const Eigen::MatrixXd& points) const {
  Eigen::MatrixXd logs(points.rows(), means.rows());
  const double constant = 0.5 * static_cast<double>(points.cols()) * std::log(2 * std::numbers::pi);
  for (Eigen::Index c = 0; c < means.rows(); ++c) {
    const Eigen::ArrayXXd scaled = (points.rowwise() - means.row(c)).array().rowwise() / deviations.row(c).array();
    const double level = std::log(shares[c]) - deviations.row(c).array().log().sum() - constant;
    logs.col(c) = level - 0.5 * scaled.square().rowwise().sum();
  }
  return logs;
}

Eigen::MatrixXd GaussianMixture::responsibilities(const Eigen::MatrixXd& points) const {
  Eigen::MatrixXd logs = log_densities(points);
  normalise_rows(logs, Eigen::VectorXd::Ones(points.rows()));
  return logs;
}

GaussianMixture fit_mixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights,
                            const MixtureSettings& settings) {
  check(points, weights, settings);
  const Eigen::VectorXd own = weights.size() == 0 ? Eigen::VectorXd::Ones(points.rows()) : weights;
  const Grouping best = group_points(points, own, settings);
  GaussianMixture mixture;
  mixture.means = best.centres;
  mixture.deviations = Eigen::MatrixXd::Constant(best.centres.rows(), points.cols(), settings.least_deviation);
  Eigen::MatrixXd responsibilities = Eigen::MatrixXd::Zero(points.rows(), best.centres.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) responsibilities(i, best.group[i]) = 1;
  double before = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= settings.iterations; ++iteration) {
    maximise(points, own, responsibilities, settings.least_deviation, mixture);
    responsibilities = mixture.log_densities(points);
    mixture.log_likelihood = normalise_rows(responsibilities, own);
    if (mixture.log_likelihood - before < settings.convergence) break;
    before = mixture.log_likelihood;
  }
  sort_components(mixture);
  return mixture;
}

}  // namespace partwise
