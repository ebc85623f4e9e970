#include "partwise/parts/surface/minimal_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace partwise {

MinimalCut::MinimalCut(int nodes, std::span<const std::pair<int, int>> links)
    : first_(static_cast<std::size_t>(nodes) + 1, 0),
      head_(2 * links.size()),
      sister_(2 * links.size()),
      place_(links.size()),
      capacity_(2 * links.size(), 0.0),
      pull_(static_cast<std::size_t>(nodes), 0.0),
      tree_(static_cast<std::size_t>(nodes)),
      parent_(static_cast<std::size_t>(nodes)),
      time_(static_cast<std::size_t>(nodes)),
      steps_(static_cast<std::size_t>(nodes)),
      active_(static_cast<std::size_t>(nodes)) {
  for (const auto& [a, b] : links) ++first_[a + 1], ++first_[b + 1];
  for (int i = 0; i < nodes; ++i) first_[i + 1] += first_[i];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [a, b] = links[i];
    const int forward = next[a]++, backward = next[b]++;
    head_[forward] = b, head_[backward] = a;
    sister_[forward] = backward, sister_[backward] = forward;
    place_[i] = forward;
  }
}

void MinimalCut::set_link(std::size_t link, double a_to_b, double b_to_a) {
  capacity_[place_[link]] = a_to_b;
  capacity_[sister_[place_[link]]] = b_to_a;
}

void MinimalCut::activate(int node) {
  if (active_[node]) return;
  active_[node] = 1;
  queue_.push_back(node);
}

void MinimalCut::start() {
  now_ = 0;
  queue_.clear();
  std::fill(active_.begin(), active_.end(), char{0});
  for (int i = 0; i < static_cast<int>(pull_.size()); ++i) {
    tree_[i] = pull_[i] > 0 ? Tree::source : pull_[i] < 0 ? Tree::sink : Tree::none;
    parent_[i] = pull_[i] != 0 ? kTerminal : kNone;
    time_[i] = 0, steps_[i] = 1;
    if (pull_[i] != 0) activate(i);
  }
}

// Takes free neighbours into the node's tree. Returns an arc from the source's tree to the sink's, or kNone.
int MinimalCut::grow(int node) {
  for (int arc = first_[node]; arc < first_[node + 1]; ++arc) {
    if (!leads_outward(arc, tree_[node])) continue;
    const int other = head_[arc];
    if (tree_[other] == Tree::none) {
      tree_[other] = tree_[node];
      parent_[other] = sister_[arc];
      time_[other] = time_[node], steps_[other] = steps_[node] + 1;
      activate(other);
    } else if (tree_[other] != tree_[node]) {
      return tree_[node] == Tree::source ? arc : sister_[arc];
    } else if (time_[other] <= time_[node] && steps_[other] > steps_[node] && parent_[other] != kTerminal) {
      parent_[other] = sister_[arc];  // a shorter way to the terminal
      time_[other] = time_[node], steps_[other] = steps_[node] + 1;
    }
  }
  return kNone;
}

// Sends what fits along the path through the bridge; nodes whose arc to the parent is used up become orphans.
double MinimalCut::augment(int bridge) {
  double flow = capacity_[bridge];
  int node = head_[sister_[bridge]];
  for (; parent_[node] != kTerminal; node = head_[parent_[node]])
    flow = std::min(flow, capacity_[sister_[parent_[node]]]);
  flow = std::min(flow, pull_[node]);
  for (node = head_[bridge]; parent_[node] != kTerminal; node = head_[parent_[node]])
    flow = std::min(flow, capacity_[parent_[node]]);
  flow = std::min(flow, -pull_[node]);

  const auto orphan = [&](int which) {
    parent_[which] = kOrphan;
    orphans_.push_back(which);
  };
  const auto send = [&](int arc) {
    capacity_[arc] -= flow;
    capacity_[sister_[arc]] += flow;
    return capacity_[arc] <= 0;
  };
  send(bridge);
  for (const bool to_source : {true, false}) {
    node = to_source ? head_[sister_[bridge]] : head_[bridge];
    while (parent_[node] != kTerminal) {
      const int arc = parent_[node], next = head_[arc];
      if (send(to_source ? sister_[arc] : arc)) orphan(node);
      node = next;
    }
    pull_[node] -= to_source ? flow : -flow;
    if (pull_[node] == 0) orphan(node);
  }
  return flow;
}

// Steps from the node to its terminal, -1 if its path ends at an orphan. Marks the path with what was found.
int MinimalCut::steps_to_terminal(int node) {
  int steps = 0, at = node;
  while (time_[at] != now_) {
    const int arc = parent_[at];
    ++steps;
    if (arc == kTerminal) {
      time_[at] = now_, steps_[at] = 1;
      --steps;
      break;
    }
    if (arc == kOrphan || arc == kNone) return -1;
    at = head_[arc];
  }
  steps += steps_[at];
  const int result = steps;
  for (at = node; time_[at] != now_; at = head_[parent_[at]]) time_[at] = now_, steps_[at] = steps--;
  return result;
}

void MinimalCut::adopt(int node) {
  const Tree tree = tree_[node];
  int best = kNone, least = std::numeric_limits<int>::max();
  for (int arc = first_[node]; arc < first_[node + 1]; ++arc) {
    const int other = head_[arc];
    if (tree_[other] != tree || !leads_outward(sister_[arc], tree) || parent_[other] == kOrphan) continue;
    const int steps = steps_to_terminal(other);
    if (steps >= 0 && steps < least) best = arc, least = steps;
  }
  if (best != kNone) {
    parent_[node] = best;
    time_[node] = now_, steps_[node] = least + 1;
    return;
  }
  for (int arc = first_[node]; arc < first_[node + 1]; ++arc) {
    const int other = head_[arc];
    if (tree_[other] != tree) continue;
    if (leads_outward(sister_[arc], tree)) activate(other);
    if (parent_[other] >= 0 && head_[parent_[other]] == node) {
      parent_[other] = kOrphan;
      orphans_.push_back(other);
    }
  }
  tree_[node] = Tree::none;
  parent_[node] = kNone;
}

void MinimalCut::adopt_all() {
  while (!orphans_.empty()) {
    const int node = orphans_.front();
    orphans_.pop_front();
    adopt(node);
  }
}

double MinimalCut::cut() {
  start();
  double flow = 0;
  while (!queue_.empty()) {
    const int node = queue_.front();
    if (tree_[node] != Tree::none) {
      const int bridge = grow(node);
      if (bridge != kNone) {
        ++now_;
        flow += augment(bridge);
        adopt_all();
        continue;  // The node may have more to find.
      }
    }
    active_[node] = 0;
    queue_.pop_front();
  }
  return flow;
}

}  // namespace partwise
