// Labels of a graph's nodes with low energy, by alpha expansion (Boykov, Veksler, Zabih 2001).
//
// Energy = sum over nodes of cost(node, label) + sum over the links whose ends differ in label of the link's weight.
// Each move lets any set of nodes change to one label at once, the best such set being a minimal cut (Kolmogorov and
// Zabih 2004 for the weights, Boykov and Kolmogorov 2004 for the cut). It stops when no move of any label lowers the
// energy: with two labels that is the minimum, with more it is at most twice the minimum if all costs are positive.
// Deterministic. Errors: InputError for a negative weight, a cost that is not finite, or a link to no node.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace partwise {

struct LabelLink {
  int a = 0, b = 0;   // nodes; a link from a node to itself counts for nothing
  double weight = 0;  // at least 0
};

double label_energy(const Eigen::MatrixXd& costs, std::span<const LabelLink> links, std::span<const int> labels);

// costs: nodes x labels. start: a label a node, or empty for the cheapest label of each node.
std::vector<int> expand_labels(const Eigen::MatrixXd& costs, std::span<const LabelLink> links,
                               std::vector<int> start = {});

}  // namespace partwise
