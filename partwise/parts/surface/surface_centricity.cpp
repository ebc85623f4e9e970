#include "partwise/parts/surface/surface_centricity.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/surface/face_clustering.h"

namespace partwise {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

using Neighbours = std::vector<std::vector<std::pair<int, double>>>;  // of each face, with the length of the way there

Neighbours neighbours_of(const Mesh& mesh) {
  const auto middle = [&](int f) -> Point {
    const auto corners = mesh.faces.row(f);
    return (mesh.vertices.row(corners[0]) + mesh.vertices.row(corners[1]) + mesh.vertices.row(corners[2])) / 3;
  };
  Neighbours result(static_cast<std::size_t>(mesh.faces.rows()));
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> sides) {
    const Point side = (mesh.vertices.row(sides[0].low) + mesh.vertices.row(sides[0].high)) / 2;
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const int a = sides[k - 1].face, b = sides[k].face;
      const double length = (middle(a) - side).norm() + (middle(b) - side).norm();
      result[a].emplace_back(b, length);
      result[b].emplace_back(a, length);
    }
  });
  return result;
}

std::vector<double> distances_from(int source, const Neighbours& neighbours) {
  std::vector<double> found(neighbours.size(), far);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  found[source] = 0;
  queue.emplace(0, source);
  while (!queue.empty()) {
    const auto [distance, face] = queue.top();
    queue.pop();
    if (distance > found[face]) continue;
    for (const auto& [next, length] : neighbours[face]) {
      if (distance + length >= found[next]) continue;
      found[next] = distance + length;
      queue.emplace(found[next], next);
    }
  }
  return found;
}

// Of each sample, the distance to every face, and the area that is nearest to it.
struct Samples {
  std::vector<std::vector<double>> distances;
  std::vector<double> areas;
};

Samples spread_samples(const Neighbours& neighbours, const std::vector<double>& areas, int count) {
  Samples result;
  std::vector<double> least(areas.size(), far);
  std::vector<int> nearest(areas.size(), -1);
  auto next = std::ranges::max_element(areas) - areas.begin();
  for (int k = 0; k < count; ++k) {
    result.distances.push_back(distances_from(static_cast<int>(next), neighbours));
    for (std::size_t f = 0; f < least.size(); ++f) {
      if (result.distances.back()[f] >= least[f]) continue;
      least[f] = result.distances.back()[f];
      nearest[f] = k;
    }
    next = std::ranges::max_element(least) - least.begin();  // a piece without a sample is infinitely far
    if (least[static_cast<std::size_t>(next)] == 0) break;   // every face is a sample
  }
  result.areas.assign(result.distances.size(), 0);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    if (nearest[f] >= 0) result.areas[static_cast<std::size_t>(nearest[f])] += areas[f];
  }
  return result;
}

}  // namespace

Eigen::VectorXd surface_centricity(const Mesh& mesh, int samples) {
  const std::vector<double> areas = face_areas(mesh);
  if (std::ranges::none_of(areas, [](double area) { return area > 0; })) {
    throw InputError("mesh", "it has no area", "give a mesh with a face of positive area");
  }
  if (samples < 1) throw InputError("samples", "there is none", "take one or more");
  const Neighbours neighbours = neighbours_of(mesh);
  const Samples found = spread_samples(neighbours, areas, samples);

  Eigen::VectorXd means = Eigen::VectorXd::Zero(mesh.faces.rows());
  Eigen::VectorXd reached = means;
  for (std::size_t k = 0; k < found.distances.size(); ++k) {
    for (Eigen::Index f = 0; f < means.size(); ++f) {
      const double distance = found.distances[k][static_cast<std::size_t>(f)];
      if (distance == far) continue;
      means[f] += found.areas[k] * distance;
      reached[f] += found.areas[k];
    }
  }
  means = (reached.array() > 0).select(means.array() / reached.array().max(1e-300), 0.0).eval();

  // All faces of a piece reach the same samples, so that each piece is measured by a middle of its own.
  const std::vector<int> whole(areas.size(), 0);
  const Components pieces = label_pieces(face_adjacency(mesh), whole);
  std::vector<double> least(static_cast<std::size_t>(pieces.count), far);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    double& own = least[static_cast<std::size_t>(pieces.label[f])];
    own = std::min(own, means[static_cast<Eigen::Index>(f)]);
  }
  Eigen::VectorXd result = Eigen::VectorXd::Ones(means.size());
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const double own = least[static_cast<std::size_t>(pieces.label[f])];
    if (own > 0) result[static_cast<Eigen::Index>(f)] = means[static_cast<Eigen::Index>(f)] / own;
  }
  return result;
}

}  // namespace partwise
