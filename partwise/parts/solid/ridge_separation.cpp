#include "partwise/parts/solid/ridge_separation.h"

#include <Eigen/Geometry>

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace partwise {
namespace {

constexpr double kConcaveTheta = 0.3, kConvexTheta = 1, kAngleShare = 0.8;

Point face_normal(const PartGraph& part, int f) {
  const auto& c = part.corners[f];
  const Point a = part.positions.row(c[0]);
  return (part.positions.row(c[1]) - a).cross(part.positions.row(c[2]) - a);
}

bool is_concave(const PartGraph& part, const PartGraph::SharedEdge& e) {
  // Concave where the other face's third corner lies in front of this face.
  const Point normal = face_normal(part, e.face);
  double height = 0;
  for (int v : part.corners[e.other]) {
    const double h = normal.dot(part.positions.row(v) - part.positions.row(e.a));
    if (std::abs(h) > std::abs(height)) height = h;
  }
  return height > 0;
}

}  // namespace

std::vector<double> cut_costs(const PartGraph& part) {
  std::vector<double> theta(part.shared.size()), length(part.shared.size());
  for (std::size_t i = 0; i < part.shared.size(); ++i) {
    theta[i] = is_concave(part, part.shared[i]) ? kConcaveTheta : kConvexTheta;
    length[i] = (part.positions.row(part.shared[i].a) - part.positions.row(part.shared[i].b)).norm();
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, part.shared.size()));
  const double mean_theta = std::max(1e-30, std::accumulate(theta.begin(), theta.end(), 0.0) / count);
  const double mean_length = std::max(1e-30, std::accumulate(length.begin(), length.end(), 0.0) / count);
  std::vector<double> cost(part.shared.size());
  for (std::size_t i = 0; i < cost.size(); ++i)
    cost[i] = kAngleShare * theta[i] / mean_theta + (1 - kAngleShare) * length[i] / mean_length;
  return cost;
}

void minimal_cut(const PartGraph& part, const std::vector<double>& costs, const std::vector<char>& ignore,
                 std::vector<int>& side) {
  // Faces that must be with one side are contracted to it: only the free ones become nodes.
  constexpr int kSource = 0, kSink = 1;
  std::vector<int> node(side.size(), -1);
  int nodes = 2;
  for (std::size_t f = 0; f < side.size(); ++f)
    if (!ignore[f]) node[f] = side[f] > 0 ? kSource : side[f] < 0 ? kSink : nodes++;

  struct Link {
    int from, to;
    double capacity;
    std::size_t pair;  // links 2 k and 2 k + 1 are each other's reverse
  };
  std::vector<Link> links;
  links.reserve(2 * part.shared.size());
  for (std::size_t i = 0; i < part.shared.size(); ++i) {
    const auto& e = part.shared[i];
    const int a = node[e.face], b = node[e.other];
    if (a < 0 || b < 0 || a == b || (a < 2 && b < 2)) continue;
    links.push_back({a, b, costs[i], links.size()});
    links.push_back({b, a, costs[i], links.size()});
  }
  std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
    if (x.from != y.from) return x.from < y.from;
    return x.to != y.to ? x.to < y.to : x.pair < y.pair;
  });
  std::vector<std::size_t> place(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) place[links[i].pair] = i;

  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property>;
  using Edge = boost::graph_traits<Graph>::edge_descriptor;
  std::vector<std::pair<int, int>> ends(links.size());
  std::vector<double> capacity(links.size()), residual(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    ends[i] = {links[i].from, links[i].to};
    capacity[i] = links[i].capacity;
  }
  const Graph graph(boost::edges_are_sorted, ends.begin(), ends.end(), static_cast<std::size_t>(nodes));
  const auto index = boost::get(boost::edge_index, graph);
  std::vector<Edge> reverse(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::size_t back = place[links[i].pair ^ 1];
    reverse[i] = Edge(static_cast<std::size_t>(links[back].from), back);
  }

  std::vector<Edge> predecessor(static_cast<std::size_t>(nodes));
  std::vector<boost::default_color_type> colour(static_cast<std::size_t>(nodes), boost::white_color);
  std::vector<long> depth(static_cast<std::size_t>(nodes));
  const auto vertex_index = boost::get(boost::vertex_index, graph);
  boost::boykov_kolmogorov_max_flow(graph, boost::make_iterator_property_map(capacity.begin(), index),
                                    boost::make_iterator_property_map(residual.begin(), index),
                                    boost::make_iterator_property_map(reverse.begin(), index),
                                    boost::make_iterator_property_map(predecessor.begin(), vertex_index),
                                    boost::make_iterator_property_map(colour.begin(), vertex_index),
                                    boost::make_iterator_property_map(depth.begin(), vertex_index), vertex_index,
                                    kSource, kSink);
  for (std::size_t f = 0; f < side.size(); ++f) {
    if (ignore[f]) continue;
    side[f] = node[f] == kSource || (node[f] > 1 && colour[node[f]] == boost::black_color) ? 1 : -1;
  }
}

namespace {

// claim[f]: the one ridge that face f must stay with, -1 where fuzzy.
std::vector<int> must_link(const PartGraph& part, const Bridges& bridges, const ConvexRidges& ridges,
                           double tolerance) {
  constexpr int kFuzzy = -1, kContested = -2;
  std::vector<std::vector<std::pair<int, double>>> reach(ridges.members.size());
  for (const Valley& valley : bridges.deep) {
    const ValleySeparators split = valley_separators(valley.profile, tolerance);
    std::vector<double> along(valley.path.size(), 0.0);
    for (std::size_t k = 1; k < along.size(); ++k) {
      along[k] = along[k - 1] + (part.positions.row(valley.path[k]) - part.positions.row(valley.path[k - 1])).norm();
    }
    reach[ridges.of_vertex[valley.path.front()]].emplace_back(valley.path.front(), along[split.first]);
    reach[ridges.of_vertex[valley.path.back()]].emplace_back(valley.path.back(), along.back() - along[split.second]);
  }
  std::vector<int> claim(part.faces.size(), kFuzzy);
  PathSearch search(part);
  for (std::size_t r = 0; r < reach.size(); ++r) {
    const std::vector<double> value = search.within_reach(reach[r]);
    for (std::size_t f = 0; f < claim.size(); ++f) {
      const auto& c = part.corners[f];
      if (value[c[0]] >= 0 || value[c[1]] >= 0 || value[c[2]] >= 0) continue;
      claim[f] = claim[f] == kFuzzy ? static_cast<int>(r) : kContested;
    }
  }
  // A ridge always keeps the faces about its own vertices.
  for (std::size_t f = 0; f < claim.size(); ++f) {
    for (int v : part.corners[f])
      if (claim[f] < 0 && ridges.of_vertex[v] >= 0) claim[f] = ridges.of_vertex[v];
    if (claim[f] == kContested) claim[f] = kFuzzy;
  }
  return claim;
}

}  // namespace

std::vector<int> separate_ridges(const PartGraph& part, const Bridges& bridges, const ConvexRidges& ridges,
                                 double tolerance) {
  const std::vector<int> claim = must_link(part, bridges, ridges, tolerance);
  const std::vector<double> costs = cut_costs(part);

  std::vector<double> diameter(ridges.members.size());
  for (std::size_t r = 0; r < diameter.size(); ++r) {
    const Vertices members = part.positions(ridges.members[r], Eigen::all);
    diameter[r] = (members.colwise().maxCoeff() - members.colwise().minCoeff()).norm();
  }
  std::vector<int> order(ridges.members.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return diameter[a] < diameter[b]; });

  std::vector<int> label(part.faces.size(), order.back());
  std::vector<char> taken(part.faces.size(), 0);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    std::vector<int> side(part.faces.size());
    for (std::size_t f = 0; f < side.size(); ++f) side[f] = claim[f] < 0 ? 0 : claim[f] == order[i] ? 1 : -1;
    minimal_cut(part, costs, taken, side);
    for (std::size_t f = 0; f < side.size(); ++f) {
      if (taken[f] || side[f] < 0) continue;
      label[f] = order[i];
      taken[f] = 1;
    }
  }
  return label;
}

}  // namespace partwise
