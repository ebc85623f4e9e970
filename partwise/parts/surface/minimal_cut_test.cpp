#include "partwise/parts/surface/minimal_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace partwise {
namespace {

struct Network {
  std::vector<std::pair<int, int>> links;
  std::vector<std::pair<double, double>> capacity;
  std::vector<double> pull;
};

// Whole numbers, so that flows are exact; links double and turn back on themselves now and then.
Network random_network(int nodes, std::mt19937_64& random) {
  Network network;
  const auto draw = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  for (int i = 0; i < 2 * nodes; ++i) {
    network.links.emplace_back(draw(nodes), draw(nodes));
    network.capacity.emplace_back(draw(6), draw(6));
  }
  for (int i = 0; i < nodes; ++i) network.pull.push_back(draw(3) == 0 ? 0 : draw(19) - 9);
  return network;
}

double cost(const Network& network, unsigned with_source) {
  double sum = 0;
  const auto in = [&](int node) { return (with_source >> node & 1) != 0; };
  for (std::size_t i = 0; i < network.pull.size(); ++i)
    sum += in(static_cast<int>(i)) ? std::max(0.0, -network.pull[i]) : std::max(0.0, network.pull[i]);
  for (std::size_t i = 0; i < network.links.size(); ++i) {
    const auto& [a, b] = network.links[i];
    if (in(a) && !in(b)) sum += network.capacity[i].first;
    if (in(b) && !in(a)) sum += network.capacity[i].second;
  }
  return sum;
}

void load(const Network& network, MinimalCut& graph) {
  for (std::size_t i = 0; i < network.pull.size(); ++i) graph.set_pull(static_cast<int>(i), network.pull[i]);
  for (std::size_t i = 0; i < network.links.size(); ++i)
    graph.set_link(i, network.capacity[i].first, network.capacity[i].second);
}

TEST(MinimalCut, IsTheCheapestOfAllAndTheSmallestOfThose) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 2000; ++round) {
    const int nodes = 1 + static_cast<int>(random() % 10);
    const Network network = random_network(nodes, random);
    MinimalCut graph(nodes, network.links);
    load(network, graph);
    const double flow = graph.cut();
    unsigned found = 0;
    for (int i = 0; i < nodes; ++i) found |= graph.with_source(i) ? 1u << i : 0;
    double least = std::numeric_limits<double>::infinity();
    unsigned common = ~0u;
    for (unsigned set = 0; set < 1u << nodes; ++set) {
      const double own = cost(network, set);
      if (own < least) least = own, common = ~0u;
      if (own == least) common &= set;
    }
    EXPECT_EQ(flow, least);
    EXPECT_EQ(cost(network, found), least);
    EXPECT_EQ(found, common);
  }
}

TEST(MinimalCut, CutsAgainWithOtherCapacities) {
  std::mt19937_64 random(12);
  Network network = random_network(60, random);
  MinimalCut again(60, network.links);
  for (int round = 0; round < 20; ++round) {
    const Network other = random_network(60, random);
    network.capacity = other.capacity, network.pull = other.pull;
    load(network, again);
    MinimalCut fresh(60, network.links);
    load(network, fresh);
    EXPECT_EQ(again.cut(), fresh.cut());
    for (int i = 0; i < 60; ++i) EXPECT_EQ(again.with_source(i), fresh.with_source(i));
  }
}

}  // namespace
}  // namespace partwise
