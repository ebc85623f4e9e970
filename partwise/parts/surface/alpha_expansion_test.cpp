#include "partwise/parts/surface/alpha_expansion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "partwise/base/error.h"

namespace partwise {
namespace {

struct Problem {
  Eigen::MatrixXd costs;
  std::vector<LabelLink> links;
};

Problem random_problem(int nodes, int labels, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Problem problem{Eigen::MatrixXd(nodes, labels), {}};
  for (double& cost : problem.costs.reshaped()) cost = 2 * unit(random) - 0.3;
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < a; ++b)
      if (unit(random) < 0.5) problem.links.push_back({a, b, unit(random)});
  if (!problem.links.empty()) problem.links.push_back(problem.links.front());  // the same ends twice
  problem.links.push_back({0, 0, 1});
  return problem;
}

// Calls visit with every labelling.
template <typename Visit>
void for_each_labelling(int nodes, int labels, const Visit& visit) {
  std::vector<int> now(static_cast<std::size_t>(nodes), 0);
  for (;;) {
    visit(now);
    int i = 0;
    while (i < nodes && ++now[i] == labels) now[i++] = 0;
    if (i == nodes) return;
  }
}

TEST(AlphaExpansion, TwoLabelsReachTheMinimum) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 300; ++round) {
    const int nodes = 1 + static_cast<int>(random() % 9);
    const auto [costs, links] = random_problem(nodes, 2, random);
    double least = std::numeric_limits<double>::infinity();
    for_each_labelling(nodes, 2,
                       [&](const std::vector<int>& l) { least = std::min(least, label_energy(costs, links, l)); });
    EXPECT_NEAR(label_energy(costs, links, expand_labels(costs, links)), least, 1e-9);
  }
}

TEST(AlphaExpansion, NoExpansionOfAnyLabelIsLower) {
  std::mt19937_64 random(8);
  for (int round = 0; round < 200; ++round) {
    const int nodes = 1 + static_cast<int>(random() % 8), count = 3 + static_cast<int>(random() % 3);
    const auto [costs, links] = random_problem(nodes, count, random);
    std::vector<int> start(static_cast<std::size_t>(nodes));
    for (int& label : start) label = static_cast<int>(random() % static_cast<unsigned>(count));
    const std::vector<int> labels = expand_labels(costs, links, round % 2 == 0 ? start : std::vector<int>{});
    const double energy = label_energy(costs, links, labels);
    for (int alpha = 0; alpha < count; ++alpha) {
      for_each_labelling(nodes, 2, [&](const std::vector<int>& changes) {
        std::vector<int> moved = labels;
        for (int i = 0; i < nodes; ++i)
          if (changes[i]) moved[i] = alpha;
        EXPECT_GE(label_energy(costs, links, moved), energy - 1e-7);
      });
    }
  }
}

TEST(AlphaExpansion, WithoutLinksEachNodeTakesItsCheapestLabel) {
  std::mt19937_64 random(9);
  const auto [costs, links] = random_problem(50, 6, random);
  const std::vector<int> labels = expand_labels(costs, {}, std::vector<int>(50, 3));
  for (Eigen::Index i = 0; i < costs.rows(); ++i) EXPECT_EQ(costs(i, labels[i]), costs.row(i).minCoeff());
}

TEST(AlphaExpansion, StrongLinksMakeOneLabelOfAComponent) {
  Eigen::MatrixXd costs(4, 2);
  costs << 0, 1, 0.4, 0, 0, 1, 1, 0;
  const std::vector<LabelLink> links = {{0, 1, 10}, {2, 3, 0.5}};
  EXPECT_EQ(expand_labels(costs, links), (std::vector<int>{0, 0, 0, 1}));
}

TEST(AlphaExpansion, NothingToLabel) { EXPECT_TRUE(expand_labels(Eigen::MatrixXd(0, 3), {}).empty()); }

TEST(AlphaExpansion, RefusesWhatItCannotUse) {
  const Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(2, 2);
  EXPECT_THROW(expand_labels(costs, std::vector<LabelLink>{{0, 2, 1}}), InputError);
  EXPECT_THROW(expand_labels(costs, std::vector<LabelLink>{{0, 1, -1}}), InputError);
  EXPECT_THROW(expand_labels(costs, {}, {0}), InputError);
  EXPECT_THROW(expand_labels(costs, {}, {0, 2}), InputError);
  EXPECT_THROW(expand_labels(Eigen::MatrixXd::Constant(2, 2, NAN), {}), InputError);
  EXPECT_THROW(expand_labels(Eigen::MatrixXd(2, 0), {}), InputError);
}

}  // namespace
}  // namespace partwise
