#include "partwise/parts/surface/face_clustering.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/parts/surface/face_values.h"
#include "partwise/parts/surface/gaussian_mixture.h"

namespace partwise {
namespace {

constexpr double kLeast = 5e-6;        // of a probability, and of an angle / pi, before its logarithm is taken
constexpr double kUnitOfLength = 200;  // roots of the whole area, divided by the number of faces

void check(const Mesh& mesh, const Eigen::MatrixXd& values, const ClusteringSettings& settings) {
  if (values.rows() != mesh.faces.rows() || values.cols() < 1) {
    throw InputError("values", fmt::format("{} rows for {} faces", values.rows(), mesh.faces.rows()),
                     "give one a face");
  }
  if (!(settings.smoothness >= 0) || !std::isfinite(settings.smoothness)) {
    throw InputError("smoothness", fmt::format("{} is out of range", settings.smoothness), "give 0 or more");
  }
  if (!(settings.convex_factor > 0 && settings.convex_factor <= 1)) {
    throw InputError("convex_factor", fmt::format("{} is out of range", settings.convex_factor),
                     "give more than 0, at most 1");
  }
}

Point area_vector(const Mesh& mesh, int face) {
  const Point a = mesh.vertices.row(mesh.faces(face, 0));
  return (mesh.vertices.row(mesh.faces(face, 1)) - a).cross(mesh.vertices.row(mesh.faces(face, 2)) - a);
}

double edge_length(const Mesh& mesh, const HalfEdge& edge) {
  return (mesh.vertices.row(edge.high) - mesh.vertices.row(edge.low)).norm();
}

// -log(t angle / pi), t by the side to which the surface bends.
double bend_weight(const Mesh& mesh, const HalfEdge& a, const HalfEdge& b, double convex_factor) {
  Point normal = area_vector(mesh, a.face), other = area_vector(mesh, b.face);
  if (a.forward == b.forward) other = -other;  // the faces do not agree on what is outside
  const double sine = normal.cross(other).norm(), cosine = normal.dot(other);
  const double angle = sine == 0 && cosine == 0 ? 0 : std::atan2(sine, cosine);
  const Point apex = mesh.vertices.row(mesh.faces(b.face, (b.corner + 2) % 3));
  const bool concave = normal.dot(apex - mesh.vertices.row(a.low)) > 0;
  return -std::log(std::max(kLeast, (concave ? 1 : convex_factor) * angle / std::numbers::pi));
}

// Visits every two faces that follow each other at an edge.
template <typename Visit>
void for_each_link(const Mesh& mesh, const Visit& visit) {
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    for (std::size_t i = 0; i + 1 < edge.size(); ++i)
      if (edge[i].face != edge[i + 1].face) visit(edge[i], edge[i + 1]);
  });
}

}  // namespace

Eigen::MatrixXd cluster_costs(const Mesh& mesh, const Eigen::MatrixXd& values, const ClusteringSettings& settings) {
  check(mesh, values, settings);
  if (!values.allFinite()) throw InputError("values", "one is not finite", "fill missing values in first");
  Eigen::MatrixXd points(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < values.cols(); ++i) points.col(i) = normalised(values.col(i), settings.bend);
  const std::vector<double> areas = face_areas(mesh);
  Eigen::VectorXd sizes = Eigen::VectorXd::Ones(values.rows());
  if (settings.by_area) sizes = Eigen::VectorXd::Map(areas.data(), values.rows());
  if (!(sizes.sum() > 0)) sizes.setOnes();
  sizes /= sizes.mean();
  const GaussianMixture mixture = fit_mixture(points, sizes, {.components = settings.clusters, .seed = settings.seed});
  return (-mixture.responsibilities(points).array().max(kLeast).log()).colwise() * sizes.array();
}

std::vector<FaceBorder> face_borders(const Mesh& mesh, double convex_factor) {
  std::vector<FaceBorder> borders;
  for_each_link(mesh, [&](const HalfEdge& a, const HalfEdge& b) {
    borders.push_back({a.face, b.face, edge_length(mesh, a), bend_weight(mesh, a, b, convex_factor)});
  });
  return borders;
}

std::vector<LabelLink> face_links(const Mesh& mesh, const ClusteringSettings& settings) {
  const std::vector<double> areas = face_areas(mesh);
  const double unit =
      kUnitOfLength * std::sqrt(std::accumulate(areas.begin(), areas.end(), 0.0)) / static_cast<double>(areas.size());
  const bool by_length = settings.by_length && unit > 0;
  std::vector<LabelLink> links;
  for (const FaceBorder& border : face_borders(mesh, settings.convex_factor))
    links.push_back({border.a, border.b, (by_length ? border.length / unit : 1) * border.flatness});
  return links;
}

Components label_pieces(const FaceAdjacency& adjacency, std::span<const int> labels) {
  Components pieces;
  pieces.label.assign(labels.size(), -1);
  std::vector<int> open;
  for (std::size_t f = 0; f < labels.size(); ++f) {
    if (pieces.label[f] >= 0) continue;
    const int piece = pieces.count++;
    pieces.label[f] = piece;
    open.assign(1, static_cast<int>(f));
    while (!open.empty()) {
      const int face = open.back();
      open.pop_back();
      for (int next : adjacency.of(face)) {
        if (pieces.label[next] >= 0 || labels[next] != labels[face]) continue;
        pieces.label[next] = piece;
        open.push_back(next);
      }
    }
  }
  return pieces;
}

Components join_small_pieces(const Mesh& mesh, Components pieces, double least_area) {
  if (least_area <= 0) return pieces;
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<std::map<int, double>> borders(count);  // of each piece: its neighbours, and the common length
  for_each_link(mesh, [&](const HalfEdge& a, const HalfEdge& b) {
    const int p = pieces.label[a.face], q = pieces.label[b.face];
    if (p == q) return;
    borders[p][q] += edge_length(mesh, a);
    borders[q][p] += edge_length(mesh, a);
  });
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> area(count, 0.0);
  for (std::size_t f = 0; f < pieces.label.size(); ++f) area[pieces.label[f]] += areas[f];
  const double least = least_area * std::accumulate(areas.begin(), areas.end(), 0.0);
  std::set<std::pair<double, int>> small;  // with their areas, those that have a neighbour to join
  for (int p = 0; p < pieces.count; ++p)
    if (area[p] < least && !borders[p].empty()) small.emplace(area[p], p);
  std::vector<int> joined(count);  // of each piece the one that it joined, or itself
  std::iota(joined.begin(), joined.end(), 0);
  while (!small.empty()) {
    const int p = small.begin()->second;
    small.erase(small.begin());
    if (borders[p].empty()) continue;  // all of its component by now
    const int target = std::ranges::max_element(borders[p], {}, [](const auto& each) { return each.second; })->first;
    small.erase({area[target], target});
    area[target] += area[p];
    if (area[target] < least) small.emplace(area[target], target);
    for (const auto& [other, length] : borders[p]) {
      borders[other].erase(p);
      if (other == target) continue;
      borders[target][other] += length;
      borders[other][target] += length;
    }
    joined[p] = target;
  }
  const auto last = [&](int p) {
    while (joined[p] != p) p = joined[p] = joined[joined[p]];
    return p;
  };
  for (int& label : pieces.label) label = last(label);
  return label_pieces(face_adjacency(mesh), pieces.label);
}

FaceClustering cluster_faces(const Mesh& mesh, const Eigen::MatrixXd& values, const ClusteringSettings& settings) {
  const Eigen::MatrixXd costs = cluster_costs(mesh, values, settings);
  std::vector<LabelLink> links = face_links(mesh, settings);
  for (LabelLink& link : links) link.weight *= settings.smoothness;
  FaceClustering result;
  result.clusters = expand_labels(costs, links);
  const Components pieces =
      join_small_pieces(mesh, label_pieces(face_adjacency(mesh), result.clusters), settings.least_area);
  result.labels = pieces.label;
  result.segments = pieces.count;
  return result;
}

}  // namespace partwise
