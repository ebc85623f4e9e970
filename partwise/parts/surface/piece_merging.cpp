#include "partwise/parts/surface/piece_merging.h"

#include <algorithm>
#include <cmath>

#include "partwise/geometry/disjoint_sets.h"

namespace partwise {

double BorderModel::likelihood(const BorderTerms& terms) const { return 1 / (1 + std::exp(-weights.dot(terms))); }

void merge_pieces(PieceGraph& graph, const BorderScore& score, double threshold,
                  const std::function<void(int, int)>& joined) {
  std::map<std::pair<int, int>, double> scores;
  for (int a = 0; a < graph.pieces(); ++a)
    for (const auto& [b, border] : graph.neighbours(a))
      if (a < b) scores[{a, b}] = score(graph, a, b);
  while (!scores.empty()) {
    const auto least = std::ranges::min_element(scores, {}, [](const auto& each) { return each.second; });
    if (!(least->second < threshold)) return;
    const auto [a, b] = least->first;
    for (const int piece : {a, b})
      for (const auto& [other, border] : graph.neighbours(piece)) scores.erase(std::minmax(piece, other));
    graph.join(a, b);
    joined(a, b);
    for (const auto& [other, border] : graph.neighbours(a)) {
      const auto [low, high] = std::minmax(a, other);
      scores[{low, high}] = score(graph, low, high);
    }
  }
}

std::vector<int> merge_pieces(PieceGraph graph, const BorderModel& model) {
  DisjointSets sets(static_cast<std::size_t>(graph.pieces()));
  const auto score = [&](const PieceGraph& now, int a, int b) { return model.likelihood(now.terms(a, b)); };
  merge_pieces(graph, score, model.threshold, [&](int a, int b) { sets.join(a, b); });
  std::vector<int> result;
  result.reserve(static_cast<std::size_t>(graph.pieces()));
  for (int piece = 0; piece < graph.pieces(); ++piece) result.push_back(sets.find(piece));
  return result;
}

}  // namespace partwise
