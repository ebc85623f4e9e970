// Parts from too many pieces: the border that people would least likely draw is taken out, again and again, until all
// that are left are likely.
//
// How likely a border is, is a logistic function of nine numbers (piece_graph.h); its weights were learnt from people's
// segmentations (bench/border_fit.cpp). After each join the numbers are taken anew. Time O(pieces x borders).
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "partwise/parts/surface/piece_graph.h"

namespace partwise {

struct BorderModel {
  BorderTerms weights = BorderTerms::Zero();
  double threshold = 0.5;  // borders at or above it stay

  double likelihood(const BorderTerms& terms) const;
};

// How much a border is worth keeping; the least goes first, ties by the numbers of the pieces.
using BorderScore = std::function<double(const PieceGraph&, int a, int b)>;

// Joins while the least score is below `threshold`. `joined` is told of each join: b became a.
void merge_pieces(PieceGraph& graph, const BorderScore& score, double threshold,
                  const std::function<void(int a, int b)>& joined);

// Of each piece the one that it became.
std::vector<int> merge_pieces(PieceGraph graph, const BorderModel& model);

}  // namespace partwise
