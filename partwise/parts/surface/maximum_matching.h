// Maximum-weight matching between the two sides of a small bipartite graph.
//
// weights(i, j) >= 0 is what it is worth to match row i with column j; each row and each column is matched at most
// once, and the sum is the largest there is. Exact, by shortest augmenting paths over potentials (Kuhn 1955, Munkres
// 1957, in the form that adds a row at a time). Time O(r^2 c) with r the shorter side. Boost's
// maximum_weighted_matching would serve, but the versions in use are known to give wrong matchings, or none, for some
// graphs (its issues 199, 223 and 399).
//
// Errors: InputError for a weight that is negative or not finite.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace partwise {

struct Matching {
  double weight = 0;
  std::vector<int> column_of_row;  // -1 for rows that stay alone: those beyond the number of columns
};

Matching maximum_weight_matching(const Eigen::MatrixXd& weights);

}  // namespace partwise
