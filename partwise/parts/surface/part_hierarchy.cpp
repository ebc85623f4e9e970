#include "partwise/parts/surface/part_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/surface/segmentation_measures.h"

namespace partwise {
namespace {

void require(const Mesh& mesh, std::span<const int> labels, const SurfaceMeasures& measures,
             const HierarchySettings& settings) {
  require_label_per_face(mesh, labels, "labels");
  for (const Eigen::VectorXd* values : {&measures.visibility, &measures.thickness, &measures.centricity}) {
    if (values->size() != mesh.faces.rows() || !values->allFinite()) {
      throw InputError("measures", "there is not one finite number a face", "give measures of this mesh");
    }
  }
  std::vector<bool> seen(labels.size() + 1, false);
  for (const int label : labels) {
    if (label < 0 || static_cast<std::size_t>(label) >= labels.size()) {
      throw InputError("labels", fmt::format("one is {}", label), "number the parts from 0");
    }
    seen[static_cast<std::size_t>(label)] = true;
  }
  const auto first_unused = std::ranges::find(seen, false);
  if (std::find(first_unused, seen.end(), true) != seen.end()) {
    throw InputError("labels", "a number below the highest is not in use", "number the parts from 0 without gaps");
  }
  if (settings.bins < 2 || !(settings.visibility_range > 0) || !(settings.thickness_range > 0) ||
      !(settings.centricity_range > 0)) {
    throw InputError("settings", "a histogram needs two bins and a range", "leave them as they are");
  }
}

// Where ratios lie among the bins, 0 .. bins - 1: `least` octaves are at the first bin, `least` + `range` at the last.
Eigen::ArrayXd places(const Eigen::VectorXd& ratios, double least, double range, int bins) {
  const Eigen::ArrayXd octaves = ratios.array().max(std::exp2(least)).min(std::exp2(least + range)).log2();
  return ((octaves - least) / range * (bins - 1)).max(0).min(bins - 1);
}

// A row a part.
Eigen::MatrixXd part_histograms(const std::vector<double>& areas, std::span<const int> labels, int parts,
                                const SurfaceMeasures& measures, const HierarchySettings& settings) {
  const int bins = settings.bins;
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  const Eigen::ArrayXd centricity = places(measures.centricity, 0, settings.centricity_range, bins);
  const Eigen::ArrayXd levels[] = {
      places(measures.visibility / whole, -settings.visibility_range, settings.visibility_range, bins),
      places(measures.thickness / std::sqrt(whole), -settings.thickness_range, settings.thickness_range, bins)};
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(parts, 2 * bins * bins);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    const auto face = static_cast<Eigen::Index>(f);
    const int out = std::min(static_cast<int>(centricity[face]), bins - 2);
    const double farther = centricity[face] - out;
    for (int table = 0; table < 2; ++table) {
      const double level = levels[table][face];
      const int bin = std::min(static_cast<int>(level), bins - 2);
      const double higher = level - bin, share = areas[f] / whole / 2;
      const auto add = [&](int row, int column, double part_of_it) {
        result(labels[f], (table * bins + row) * bins + column) += share * part_of_it;
      };
      add(bin, out, (1 - higher) * (1 - farther));
      add(bin, out + 1, (1 - higher) * farther);
      add(bin + 1, out, higher * (1 - farther));
      add(bin + 1, out + 1, higher * farther);
    }
  }
  return result;
}

// Of each part, the parts with which it shares an edge, ascending.
std::vector<std::vector<int>> neighbours_of(const Mesh& mesh, std::span<const int> labels, int parts) {
  const FaceAdjacency adjacency = face_adjacency(mesh);
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(parts));
  for (int f = 0; f < static_cast<int>(labels.size()); ++f) {
    for (const int g : adjacency.of(f)) {
      if (labels[f] != labels[g]) neighbours[labels[f]].push_back(labels[g]);
    }
  }
  for (std::vector<int>& own : neighbours) {
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return neighbours;
}

// The outermost part first.
std::vector<int> from_outside(std::span<const int> labels, int parts, const Eigen::VectorXd& centricity) {
  std::vector<double> least(static_cast<std::size_t>(parts), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < labels.size(); ++f) {
    least[labels[f]] = std::min(least[labels[f]], centricity[static_cast<Eigen::Index>(f)]);
  }
  std::vector<int> order(static_cast<std::size_t>(parts));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int part) { return std::tuple(-least[part], -part); });
  return order;
}

// Taking the most central part away again and again, seen backwards: parts arrive from the outside in, and each becomes
// the middle of what it joins.
std::vector<int> tree_of(const std::vector<std::vector<int>>& neighbours, const std::vector<int>& order) {
  const std::size_t parts = neighbours.size();
  std::vector<int> parents(parts, -1);
  std::vector<int> top(parts, -1);  // of each set, by its name, the node of all of it; -1: not there yet
  DisjointSets sets(parts);
  const auto gather = [&](std::vector<int> children) {
    std::ranges::sort(children);
    children.erase(std::unique(children.begin(), children.end()), children.end());
    if (children.size() == 1) return children.front();
    const int node = static_cast<int>(parents.size());
    for (const int child : children) parents[child] = node;
    parents.push_back(-1);
    return node;
  };
  for (const int part : order) {
    std::vector<int> children = {part};
    std::vector<int> joined;
    for (const int other : neighbours[part]) {
      const int limb = top[sets.find(other)];
      if (limb < 0) continue;
      children.push_back(limb);
      joined.push_back(other);
    }
    const int node = gather(std::move(children));
    for (const int other : joined) sets.join(part, other);
    top[sets.find(part)] = node;
  }
  std::vector<int> pieces;
  for (std::size_t part = 0; part < parts; ++part) pieces.push_back(top[sets.find(static_cast<int>(part))]);
  gather(std::move(pieces));
  return parents;
}

}  // namespace

std::vector<int> PartHierarchy::root_path(int part) const {
  std::vector<int> path;
  for (int node = part; node >= 0; node = parents[static_cast<std::size_t>(node)]) path.push_back(node);
  return path;
}

PartHierarchy part_hierarchy(const Mesh& mesh, std::span<const int> labels, const SurfaceMeasures& measures,
                             const HierarchySettings& settings) {
  require(mesh, labels, measures, settings);
  const std::vector<double> areas = face_areas(mesh);
  if (!(std::accumulate(areas.begin(), areas.end(), 0.0) > 0)) {
    throw InputError("mesh", "it has no area", "give a mesh with a face of positive area");
  }
  PartHierarchy result;
  result.parts = *std::ranges::max_element(labels) + 1;
  result.parents =
      tree_of(neighbours_of(mesh, labels, result.parts), from_outside(labels, result.parts, measures.centricity));
  const Eigen::MatrixXd own = part_histograms(areas, labels, result.parts, measures, settings);
  result.histograms = Eigen::MatrixXd::Zero(result.nodes(), own.cols());
  result.histograms.topRows(result.parts) = own;
  for (int node = 0; node + 1 < result.nodes(); ++node) {  // parents come later
    result.histograms.row(result.parents[node]) += result.histograms.row(node);
  }
  return result;
}

}  // namespace partwise
