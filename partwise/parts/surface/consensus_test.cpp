#include "partwise/parts/surface/consensus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using Labels = std::vector<int>;

std::vector<Labels> noisy_copies(const Labels& truth, int copies, double noise, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Labels> result;
  for (int i = 0; i < copies; ++i) {
    Labels labels = truth;
    for (int& label : labels) {
      if (unit(random) < noise) label = static_cast<int>(random() % 4);
      label = (label + i) % 4;  // What labels are called differs.
    }
    result.push_back(labels);
  }
  return result;
}

double closeness(const std::vector<Labels>& all, std::size_t a, std::size_t b) {
  double together = 0;
  for (const Labels& labels : all) together += labels[a] == labels[b];
  return together / static_cast<double>(all.size());
}

double mean_closeness(const std::vector<Labels>& all, const Labels& result, int g, int h) {
  double sum = 0, pairs = 0;
  for (std::size_t a = 0; a < result.size(); ++a)
    for (std::size_t b = 0; b < result.size(); ++b)
      if (result[a] == g && result[b] == h) sum += closeness(all, a, b), ++pairs;
  return sum / pairs;
}

TEST(Consensus, OfEqualSegmentationsIsTheirs) {
  EXPECT_EQ(consensus_labels(std::vector<Labels>{{3, 3, 1, 1, 0, 3}, {0, 0, 5, 5, 2, 0}}), (Labels{0, 0, 1, 1, 2, 0}));
  EXPECT_EQ(consensus_labels(std::vector<Labels>{{}}), Labels{});
}

TEST(Consensus, IsWhatMostSay) {
  const std::vector<Labels> votes = {{0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}};
  EXPECT_EQ(consensus_labels(votes), (Labels{0, 0, 1, 1}));
  EXPECT_EQ(consensus_labels(votes, {.agreement = 1}), (Labels{0, 0, 1, 2}));
  EXPECT_EQ(consensus_labels(votes, {.agreement = 0}), (Labels{0, 0, 0, 0}));
}

TEST(Consensus, RecoversWhatNoiseHides) {
  std::mt19937_64 random(1);
  Labels truth;
  for (int f = 0; f < 400; ++f) truth.push_back(f / 100);
  const std::vector<Labels> copies = noisy_copies(truth, 25, 0.15, random);
  EXPECT_EQ(consensus_labels(copies), truth);
  EXPECT_EQ(consensus_labels(copies, {.agreement = 0.5, .largest_atoms = 40}), truth);
}

TEST(Consensus, NoTwoGroupsAreCloserThanTheAgreement) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 30; ++round) {
    std::vector<Labels> all(5, Labels(12));
    for (Labels& labels : all)
      for (int& label : labels) label = static_cast<int>(random() % 3);
    const Labels result = consensus_labels(all);
    const int groups = *std::max_element(result.begin(), result.end()) + 1;
    for (int g = 0; g < groups; ++g)
      for (int h = 0; h < g; ++h) EXPECT_LE(mean_closeness(all, result, g, h), 0.5 + 1e-12);
  }
}

TEST(Consensus, RefusesWhatItCannotUse) {
  EXPECT_THROW(consensus_labels({}), InputError);
  EXPECT_THROW(consensus_labels(std::vector<Labels>{{0, 1}, {0}}), InputError);
  EXPECT_THROW(consensus_labels(std::vector<Labels>{{0, 1}}, {.agreement = 1.5}), InputError);
}

}  // namespace
}  // namespace partwise
