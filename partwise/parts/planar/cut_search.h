// Small cut problems solved without a solver of 0-1 programmes, whose start alone takes longer (see cut_selection.h).
#pragma once

#include <optional>
#include <vector>

#include "partwise/parts/planar/cut_selection.h"

namespace partwise {

// The resolvers that are worth looking at: of two of one feature that resolve the same features, the one is dropped
// that has as many diagonals of its own as the other has in all, and no higher score. Some best choice always remains.
// Only for problems without further conflicts. Ascending.
std::vector<int> undominated_resolvers(const CutProblem& problem);

// A best choice among these resolvers by branch and bound over the features that they resolve; nothing when that takes
// more than `steps` steps.
std::optional<std::vector<int>> search_cuts(const CutProblem& problem, const std::vector<int>& resolvers, int steps);

}  // namespace partwise
