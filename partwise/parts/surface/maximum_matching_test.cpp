#include "partwise/parts/surface/maximum_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// All ways to give rows different columns or none.
double best_by_trying(const Eigen::MatrixXd& weights, int row, std::vector<bool>& taken) {
  if (row == weights.rows()) return 0;
  double best = best_by_trying(weights, row + 1, taken);
  for (int k = 0; k < weights.cols(); ++k) {
    if (taken[k]) continue;
    taken[k] = true;
    best = std::max(best, weights(row, k) + best_by_trying(weights, row + 1, taken));
    taken[k] = false;
  }
  return best;
}

void expect_valid(const Matching& found, const Eigen::MatrixXd& weights) {
  ASSERT_EQ(static_cast<Eigen::Index>(found.column_of_row.size()), weights.rows());
  std::vector<int> seen(static_cast<std::size_t>(weights.cols()), 0);
  double sum = 0;
  for (int i = 0; i < weights.rows(); ++i) {
    const int k = found.column_of_row[i];
    if (k < 0) continue;
    ASSERT_LT(k, weights.cols());
    ++seen[k];
    sum += weights(i, k);
  }
  EXPECT_LE(*std::ranges::max_element(seen), 1);
  EXPECT_DOUBLE_EQ(sum, found.weight);
}

TEST(MaximumMatching, EqualsTryingEverything) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 600; ++trial) {
    const auto rows = std::uniform_int_distribution(1, 6)(random),
               columns = std::uniform_int_distribution(1, 6)(random);
    Eigen::MatrixXd weights(rows, columns);
    // Every third with many ties and zeros.
    for (double& weight : weights.reshaped()) {
      weight =
          trial % 3 == 0 ? std::uniform_int_distribution(0, 2)(random) : std::uniform_real_distribution(0., 1.)(random);
    }
    const Matching found = maximum_weight_matching(weights);
    expect_valid(found, weights);
    std::vector<bool> taken(static_cast<std::size_t>(columns), false);
    EXPECT_NEAR(found.weight, best_by_trying(weights, 0, taken), 1e-12) << weights;
  }
}

TEST(MaximumMatching, ABestPairMayHaveToBeGivenUp) {
  Eigen::MatrixXd weights(2, 2);
  weights << 10, 9, 9, 1;
  EXPECT_EQ(maximum_weight_matching(weights).weight, 18);
}

TEST(MaximumMatching, NothingToMatch) {
  EXPECT_EQ(maximum_weight_matching(Eigen::MatrixXd(0, 3)).weight, 0);
  const Matching alone = maximum_weight_matching(Eigen::MatrixXd(2, 0));
  EXPECT_EQ(alone.weight, 0);
  EXPECT_EQ(alone.column_of_row, (std::vector<int>{-1, -1}));
}

TEST(MaximumMatching, RefusesWeightsWithoutSense) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Ones(2, 2);
  weights(1, 0) = -1e-9;
  EXPECT_THROW(maximum_weight_matching(weights), InputError);
  weights(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(maximum_weight_matching(weights), InputError);
}

}  // namespace
}  // namespace partwise
