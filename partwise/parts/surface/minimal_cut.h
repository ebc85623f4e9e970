// Minimal cuts of one graph whose capacities change from cut to cut (Boykov and Kolmogorov 2004).
//
// The terminals are no nodes of the graph: each node has one number that says how much more it is held by the source
// than by the sink. On the graphs of faces that is several times faster than a general library's flow, and the flow is
// where segmentation spends its time. Deterministic.
#pragma once

#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace partwise {

class MinimalCut {
 public:
  // links: pairs of nodes 0 .. nodes - 1; several may join the same two, and one may join a node with itself.
  MinimalCut(int nodes, std::span<const std::pair<int, int>> links);

  // All capacities start at 0. `pull` > 0 is the cost of having the node with the sink, < 0 minus that with the source.
  void set_pull(int node, double pull) { pull_[node] = pull; }
  // The cost of having a with the source and b with the sink, and the other way round; both at least 0.
  void set_link(std::size_t link, double a_to_b, double b_to_a);

  // Cuts, and uses the capacities up. Returns the largest flow: the cost of the cut, less that of no pull at all.
  double cut();
  // After cut(): the smallest set of nodes that a minimal cut leaves with the source.
  bool with_source(int node) const { return tree_[node] == Tree::source; }

 private:
  enum class Tree : char { none, source, sink };
  static constexpr int kNone = -1, kTerminal = -2, kOrphan = -3;

  void start();
  int grow(int node);
  double augment(int bridge);
  void adopt_all();
  void adopt(int node);
  int steps_to_terminal(int node);
  void activate(int node);
  bool leads_outward(int arc, Tree tree) const { return capacity_[tree == Tree::source ? arc : sister_[arc]] > 0; }

  std::vector<int> first_, head_, sister_, place_;  // arcs by their tail; place of each link's first arc
  std::vector<double> capacity_, pull_;
  std::vector<Tree> tree_;
  std::vector<int> parent_;        // the arc to a node's parent
  std::vector<int> time_, steps_;  // when the number of steps to the terminal was last known
  std::vector<char> active_;
  std::deque<int> queue_, orphans_;
  int now_ = 0;
};

}  // namespace partwise
