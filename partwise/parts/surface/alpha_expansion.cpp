#include "partwise/parts/surface/alpha_expansion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/parts/surface/minimal_cut.h"

namespace partwise {
namespace {

constexpr double kGain = 1e-9;  // of the energy: a move has to gain more, or rounding could go round in circles

void check(const Eigen::MatrixXd& costs, std::span<const LabelLink> links, const std::vector<int>& start) {
  if (costs.cols() < 1) throw InputError("costs", "there are no labels", "give a column a label");
  if (!costs.allFinite()) throw InputError("costs", "one is not finite", "give a large cost for what is forbidden");
  for (const LabelLink& link : links) {
    if (std::min(link.a, link.b) < 0 || std::max(link.a, link.b) >= costs.rows()) {
      throw InputError("links", fmt::format("one joins nodes {} and {} of {}", link.a, link.b, costs.rows()),
                       "name nodes that have costs");
    }
    if (!(link.weight >= 0) || !std::isfinite(link.weight)) {
      throw InputError("links", fmt::format("{} is no weight", link.weight), "give 0 or more");
    }
  }
  if (start.empty()) return;
  const bool fits = static_cast<Eigen::Index>(start.size()) == costs.rows() &&
                    std::all_of(start.begin(), start.end(), [&](int l) { return l >= 0 && l < costs.cols(); });
  if (!fits)
    throw InputError("start", "the labels do not fit the costs", "give one a node, below the number of labels");
}

// The best expansion of one label: nodes on the sink's side keep their label, those on the source's side change.
std::vector<int> best_move(const Eigen::MatrixXd& costs, std::span<const LabelLink> links,
                           const std::vector<int>& labels, int alpha, MinimalCut& graph) {
  // What keeping costs more than changing, a node. A link that is cut in a way that depends on one end only is a cost
  // of that end.
  Eigen::VectorXd keeping(costs.rows());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) keeping[i] = costs(i, labels[i]) - costs(i, alpha);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [a, b, weight] = links[i];
    graph.set_link(i, 0, 0);
    if (a == b || (labels[a] == alpha && labels[b] == alpha)) continue;
    if (labels[a] == alpha || labels[b] == alpha) {
      keeping[labels[a] == alpha ? b : a] += weight;
    } else if (labels[a] == labels[b]) {
      graph.set_link(i, weight, weight);
    } else {
      keeping[a] += weight;  // if a keeps its label, and through the link if only a changes
      graph.set_link(i, weight, 0);
    }
  }
  for (Eigen::Index i = 0; i < costs.rows(); ++i) graph.set_pull(static_cast<int>(i), keeping[i]);
  graph.cut();
  std::vector<int> moved = labels;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (graph.with_source(static_cast<int>(i))) moved[i] = alpha;
  return moved;
}

}  // namespace

double label_energy(const Eigen::MatrixXd& costs, std::span<const LabelLink> links, std::span<const int> labels) {
  double energy = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) energy += costs(static_cast<Eigen::Index>(i), labels[i]);
  for (const LabelLink& link : links)
    if (labels[link.a] != labels[link.b]) energy += link.weight;
  return energy;
}

std::vector<int> expand_labels(const Eigen::MatrixXd& costs, std::span<const LabelLink> links, std::vector<int> start) {
  check(costs, links, start);
  std::vector<int> labels = std::move(start);
  if (labels.empty()) {
    labels.resize(static_cast<std::size_t>(costs.rows()));
    for (Eigen::Index i = 0; i < costs.rows(); ++i) costs.row(i).minCoeff(&labels[i]);
  }
  std::vector<std::pair<int, int>> ends;
  for (const LabelLink& link : links) ends.emplace_back(link.a, link.b);
  MinimalCut graph(static_cast<int>(costs.rows()), ends);
  double energy = label_energy(costs, links, labels);
  const int count = static_cast<int>(costs.cols());
  int idle = 0;  // moves in a row that gained nothing
  for (int alpha = 0; idle < count && count > 1; alpha = (alpha + 1) % count) {
    std::vector<int> moved = best_move(costs, links, labels, alpha, graph);
    const double lower = label_energy(costs, links, moved);
    ++idle;
    if (!(lower < energy - kGain * std::abs(energy))) continue;
    labels = std::move(moved);
    energy = lower;
    idle = 1;
  }
  return labels;
}

}  // namespace partwise
