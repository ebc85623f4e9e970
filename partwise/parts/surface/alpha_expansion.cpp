#include "partwise/parts/surface/alpha_expansion.h"

#include <fmt/format.h>

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "partwise/base/error.h"

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

// The graph of one move. Its shape is the same for all moves, only capacities change: nodes 0 .. n - 1, the source n
// and the sink n + 1, both joined to every node, and the links.
class MoveGraph {
 public:
  MoveGraph(int nodes, std::span<const LabelLink> links) : nodes_(nodes) {
    const std::size_t pairs = 2 * static_cast<std::size_t>(nodes) + links.size();
    std::vector<std::pair<int, int>> ends;
    ends.reserve(2 * pairs);
    const auto add_pair = [&](int from, int to) {
      ends.emplace_back(from, to);
      ends.emplace_back(to, from);
    };
    for (int node = 0; node < nodes; ++node) {
      add_pair(nodes, node);
      add_pair(node, nodes + 1);
    }
    for (const LabelLink& link : links) add_pair(link.a, link.b);
    sort_ends(ends);
  }

  // The capacities, as the pairs were added: 4 node: source to node, 4 node + 2: node to sink, 4 nodes + 2 link: a to b
  // and 4 nodes + 2 link + 1: b to a.
  double& from_source(int node) { return capacity_[place_[4 * static_cast<std::size_t>(node)]]; }
  double& to_sink(int node) { return capacity_[place_[4 * static_cast<std::size_t>(node) + 2]]; }
  double& forward(std::size_t link) { return capacity_[place_[4 * static_cast<std::size_t>(nodes_) + 2 * link]]; }
  double& backward(std::size_t link) { return capacity_[place_[4 * static_cast<std::size_t>(nodes_) + 2 * link + 1]]; }

  void clear() { std::fill(capacity_.begin(), capacity_.end(), 0.0); }

  // True for the nodes that a minimal cut leaves with the source.
  const std::vector<char>& cut() {
    const auto edge_index = boost::get(boost::edge_index, graph_);
    const auto vertex_index = boost::get(boost::vertex_index, graph_);
    std::fill(colour_.begin(), colour_.end(), boost::white_color);
    boost::boykov_kolmogorov_max_flow(graph_, boost::make_iterator_property_map(capacity_.begin(), edge_index),
                                      boost::make_iterator_property_map(residual_.begin(), edge_index),
                                      boost::make_iterator_property_map(reverse_.begin(), edge_index),
                                      boost::make_iterator_property_map(predecessor_.begin(), vertex_index),
                                      boost::make_iterator_property_map(colour_.begin(), vertex_index),
                                      boost::make_iterator_property_map(depth_.begin(), vertex_index), vertex_index,
                                      static_cast<std::size_t>(nodes_), static_cast<std::size_t>(nodes_ + 1));
    for (int node = 0; node < nodes_; ++node) side_[node] = colour_[node] == boost::black_color;
    return side_;
  }

 private:
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property>;
  using Edge = boost::graph_traits<Graph>::edge_descriptor;

  void sort_ends(const std::vector<std::pair<int, int>>& ends) {
    // Counting sort by the first end; links that share both ends keep their order, so that each finds its reverse.
    const auto all = static_cast<std::size_t>(nodes_) + 2;
    std::vector<std::size_t> next(all + 1, 0);
    for (const auto& end : ends) ++next[static_cast<std::size_t>(end.first) + 1];
    for (std::size_t i = 0; i < all; ++i) next[i + 1] += next[i];
    place_.resize(ends.size());
    std::vector<std::pair<int, int>> sorted(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      place_[i] = next[static_cast<std::size_t>(ends[i].first)]++;
      sorted[place_[i]] = ends[i];
    }
    graph_ = Graph(boost::edges_are_sorted, sorted.begin(), sorted.end(), all);
    reverse_.resize(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i)
      reverse_[place_[i]] = Edge(static_cast<std::size_t>(ends[i ^ 1].first), place_[i ^ 1]);
    capacity_.resize(ends.size()), residual_.resize(ends.size());
    predecessor_.resize(all), colour_.resize(all), depth_.resize(all), side_.resize(all - 2);
  }

  int nodes_;
  Graph graph_;
  std::vector<std::size_t> place_;
  std::vector<Edge> reverse_, predecessor_;
  std::vector<double> capacity_, residual_;
  std::vector<boost::default_color_type> colour_;
  std::vector<long> depth_;
  std::vector<char> side_;
};

// The best expansion of one label: nodes on the sink's side keep their label, those on the source's side change.
std::vector<int> best_move(const Eigen::MatrixXd& costs, std::span<const LabelLink> links,
                           const std::vector<int>& labels, int alpha, MoveGraph& graph) {
  graph.clear();
  // What keeping costs more than changing, a node. A link that is cut in a way that depends on one end only is a cost
  // of that end.
  Eigen::VectorXd keeping(costs.rows());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) keeping[i] = costs(i, labels[i]) - costs(i, alpha);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [a, b, weight] = links[i];
    if (a == b || (labels[a] == alpha && labels[b] == alpha)) continue;
    if (labels[a] == alpha || labels[b] == alpha) {
      keeping[labels[a] == alpha ? b : a] += weight;
    } else if (labels[a] == labels[b]) {
      graph.forward(i) = graph.backward(i) = weight;
    } else {
      // w unless both change: w if a keeps, and w if a changes while b keeps.
      keeping[a] += weight;
      graph.forward(i) = weight;
    }
  }
  for (int i = 0; i < static_cast<int>(costs.rows()); ++i)
    (keeping[i] > 0 ? graph.from_source(i) : graph.to_sink(i)) = std::abs(keeping[i]);
  const std::vector<char>& changes = graph.cut();
  std::vector<int> moved = labels;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (changes[i]) moved[i] = alpha;
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
  MoveGraph graph(static_cast<int>(costs.rows()), links);
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
