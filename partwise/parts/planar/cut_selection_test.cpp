#include "partwise/parts/planar/cut_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace partwise {
namespace {

using Cost = std::tuple<int, int, double>;  // unresolved, distinct diagonals, minus the sum of scores

Cost cost_of(const CutProblem& problem, const std::vector<int>& chosen) {
  std::set<int> resolved, diagonals;
  double score = 0;
  for (int i : chosen) {
    const Resolver& resolver = problem.resolvers[i];
    resolved.insert(resolver.resolves.begin(), resolver.resolves.end());
    diagonals.insert(resolver.diagonals.begin(), resolver.diagonals.end());
    score += resolver.score;
  }
  return {problem.features - static_cast<int>(resolved.size()), static_cast<int>(diagonals.size()), -score};
}

bool is_free_of_conflicts(const CutProblem& problem, const std::vector<int>& chosen) {
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    for (std::size_t b = a + 1; b < chosen.size(); ++b) {
      if (in_conflict(problem, chosen[a], chosen[b])) return false;
    }
  }
  return true;
}

Cost brute_force(const CutProblem& problem) {
  Cost best{problem.features + 1, 0, 0};
  for (unsigned mask = 0; mask < (1u << problem.resolvers.size()); ++mask) {
    std::vector<int> chosen;
    for (std::size_t i = 0; i < problem.resolvers.size(); ++i) {
      if (mask & (1u << i)) chosen.push_back(static_cast<int>(i));
    }
    const Cost cost = cost_of(problem, chosen);
    if (cost < best && is_free_of_conflicts(problem, chosen)) best = cost;
  }
  return best;
}

CutProblem random_problem(std::mt19937_64& random, int most_resolvers, bool conflicts) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  CutProblem problem;
  problem.features = 2 + below(5);
  problem.diagonals = 2 + below(9);
  const int resolvers = 1 + below(most_resolvers);
  for (int i = 0; i < resolvers; ++i) {
    Resolver resolver;
    resolver.feature = below(problem.features);
    std::set<int> resolves{resolver.feature}, diagonals{below(problem.diagonals)};
    if (below(3) == 0) resolves.insert(below(problem.features));
    if (below(3) == 0) diagonals.insert(below(problem.diagonals));
    resolver.resolves.assign(resolves.begin(), resolves.end());
    resolver.diagonals.assign(diagonals.begin(), diagonals.end());
    resolver.score = 0.1 * (1 + below(100));
    problem.resolvers.push_back(resolver);
  }
  for (int i = 0; conflicts && i < 2; ++i) {
    const int a = below(resolvers), b = below(resolvers);
    if (a != b) problem.conflicts.emplace_back(a, b);
  }
  return problem;
}

void expect_best(const CutProblem& problem, const CutChoice& choice) {
  EXPECT_TRUE(is_free_of_conflicts(problem, choice.resolvers));
  const auto [unresolved, diagonals, score] = cost_of(problem, choice.resolvers);
  const auto [least_unresolved, least_diagonals, best_score] = brute_force(problem);
  EXPECT_EQ(unresolved, least_unresolved);
  EXPECT_EQ(unresolved, static_cast<int>(choice.unresolved.size()));
  EXPECT_EQ(diagonals, least_diagonals);
  EXPECT_NEAR(score, best_score, 1e-9);
}

TEST(CutSelection, SearchEqualsBruteForce) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 1000; ++round) {
    const CutProblem problem = random_problem(random, 13, false);
    expect_best(problem, select_cuts(problem));
  }
}

TEST(CutSelection, ProgrammeEqualsBruteForce) {
  std::mt19937_64 random(12);
  for (int round = 0; round < 1000; ++round) {
    const CutProblem problem = random_problem(random, round % 50 == 0 ? 18 : 12, round % 2 == 0);
    expect_best(problem, select_cuts(problem, 0));
  }
}

TEST(CutSelection, ProgrammeTakesOverWhereTheSearchGivesUp) {
  std::mt19937_64 random(13);
  for (int round = 0; round < 20; ++round) {
    CutProblem problem = random_problem(random, 12, false);
    const CutChoice one = select_cuts(problem, 1), full = select_cuts(problem);
    EXPECT_EQ(one.unresolved.size(), full.unresolved.size());
  }
}

// Figure 2.17: v is resolved by {vx, vz} or {vy}, x by {xv} or {xw}. The diagonal vx serves both features.
TEST(CutSelection, SharedDiagonals) {
  CutProblem problem;  // features v, x; diagonals vx 0, vz 1, vy 2, xw 3
  problem.features = 2, problem.diagonals = 4;
  problem.resolvers = {{0, {0, 1}, {0}, 1.0}, {0, {2}, {0}, 1.0}, {1, {0}, {0, 1}, 1.0}, {1, {3}, {1}, 9.0}};
  const CutChoice choice = select_cuts(problem);
  EXPECT_EQ(choice.resolvers, std::vector<int>{2});  // one diagonal resolves both
  EXPECT_TRUE(choice.unresolved.empty());
}

TEST(CutSelection, WithoutResolversEveryFeatureStays) {
  CutProblem problem;
  problem.features = 3;
  EXPECT_EQ(select_cuts(problem).unresolved, (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(select_cuts({}).resolvers.empty());
}

}  // namespace
}  // namespace partwise
