// The choice of cuts (Liu 2017, section 2.3.3.3.2). The equations (2.3) to (2.5) are lost in the text that we have;
// what stands here keeps to its words and to the cut score of the same group's acd2d.
//
// A resolver is a set of diagonals that resolves one feature, and perhaps others as well. Chosen are resolvers such
// that every feature is resolved by one of them, no two of them conflict, and, in this order: as few features as
// possible stay without, the resolvers have as few distinct diagonals as possible, and the sum of their scores is as
// large as possible. Conflicting are two resolvers of the same feature, two where one resolves the feature of the other
// already, and pairs named in `conflicts` (crossing diagonals).
//
// Solved exactly for each connected component of the conflict graph: by branch and bound, and as a 0-1 programme by CBC
// where that takes more than a number of steps (0: always).
#pragma once

#include <utility>
#include <vector>

namespace partwise {

struct Resolver {
  int feature = 0;
  std::vector<int> diagonals;  // indices of diagonals, ascending
  std::vector<int> resolves;   // features, among them its own, ascending
  double score = 0;            // not negative
};

struct CutProblem {
  int features = 0;
  int diagonals = 0;
  std::vector<Resolver> resolvers;
  std::vector<std::pair<int, int>> conflicts;  // further ones, of resolvers
};

struct CutChoice {
  std::vector<int> resolvers;   // ascending
  std::vector<int> unresolved;  // features, ascending
};

bool in_conflict(const CutProblem& problem, int i, int j);

CutChoice select_cuts(const CutProblem& problem, int search_steps = 100000);

}  // namespace partwise
