#include "partwise/parts/surface/part_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/surface/segmentation_measures.h"

namespace partwise {
namespace {

void require(const Mesh& mesh, std::span<const int> labels, const Eigen::VectorXd& values,
             const HierarchySettings& settings) {
  require_label_per_face(mesh, labels, "labels");
  if (values.size() != mesh.faces.rows() || !values.allFinite()) {
    throw InputError("values", "there is not one finite number a face", "give continuous visibility of this mesh");
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
  if (settings.bins < 2 || !(settings.octaves > 0)) {
    throw InputError("settings", "a histogram needs two bins and a range", "leave them as they are");
  }
}

// Of each face, in octaves above the least that is told apart.
Eigen::VectorXd levels_of(const Eigen::VectorXd& values, double mesh_area, double octaves) {
  const double least = std::exp2(-octaves);
  return (values.array() / mesh_area).max(least).min(1).log2() + octaves;
}

struct PartSummary {
  Eigen::MatrixXd histograms;
  Eigen::VectorXd levels;  // means, octaves
};

PartSummary summary_of(const std::vector<double>& areas, std::span<const int> labels, int parts,
                       const Eigen::VectorXd& levels, const HierarchySettings& settings) {
  PartSummary result{Eigen::MatrixXd::Zero(parts, settings.bins), Eigen::VectorXd::Zero(parts)};
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(parts), plain = weights, counts = weights;
  for (std::size_t f = 0; f < labels.size(); ++f) {
    const int part = labels[f];
    const double level = levels[static_cast<Eigen::Index>(f)];
    const double place = level / settings.octaves * (settings.bins - 1);
    const int bin = std::min(static_cast<int>(place), settings.bins - 2);
    result.histograms(part, bin) += areas[f] / all * (bin + 1 - place);
    result.histograms(part, bin + 1) += areas[f] / all * (place - bin);
    result.levels[part] += areas[f] * level;
    weights[part] += areas[f];
    plain[part] += level;
    ++counts[part];
  }
  for (int part = 0; part < parts; ++part) {  // parts of degenerate faces have no area
    result.levels[part] = weights[part] > 0 ? result.levels[part] / weights[part] : plain[part] / counts[part];
  }
  return result;
}

using Link = std::pair<int, int>;

// Pairs of parts that share an edge, each once, ascending.
std::vector<Link> links_of(const Mesh& mesh, std::span<const int> labels) {
  const FaceAdjacency adjacency = face_adjacency(mesh);
  std::vector<Link> links;
  for (int f = 0; f < static_cast<int>(labels.size()); ++f) {
    for (const int g : adjacency.of(f)) {
      if (labels[f] < labels[g]) links.emplace_back(labels[f], labels[g]);
    }
  }
  std::ranges::sort(links);
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

// Grows the tree group by group; members of a group are nodes without a parent so far.
class TreeBuilder {
 public:
  explicit TreeBuilder(int parts) : parents_(static_cast<std::size_t>(parts), -1), top_(parents_.size()) {
    std::iota(top_.begin(), top_.end(), 0);
  }

  // Parts of one set come under one node.
  void gather(DisjointSets& sets) {
    std::vector<std::vector<int>> members(top_.size());  // of each set, the nodes on top, by its representative
    for (std::size_t part = 0; part < top_.size(); ++part) {
      std::vector<int>& own = members[static_cast<std::size_t>(sets.find(static_cast<int>(part)))];
      if (std::ranges::find(own, top_[part]) == own.end()) own.push_back(top_[part]);
    }
    std::vector<int> new_node(parents_.size(), -1);
    const std::size_t before = parents_.size();
    for (std::size_t part = 0; part < top_.size(); ++part) {  // by the first part of each set
      std::vector<int>& own = members[static_cast<std::size_t>(sets.find(static_cast<int>(part)))];
      if (own.size() < 2) continue;
      for (const int node : own) new_node[node] = static_cast<int>(parents_.size());
      parents_.push_back(-1);
      own.clear();
    }
    for (std::size_t node = 0; node < before; ++node) {
      if (new_node[node] >= 0) parents_[node] = new_node[node];
    }
    for (int& node : top_) {
      if (new_node[node] >= 0) node = new_node[node];
    }
  }

  std::vector<int> take() { return std::move(parents_); }

 private:
  std::vector<int> parents_;
  std::vector<int> top_;  // of each part, the highest node above it
};

std::vector<int> tree_of(const std::vector<Link>& links, const Eigen::VectorXd& levels,
                         const std::vector<double>& steps) {
  const int parts = static_cast<int>(levels.size());
  TreeBuilder tree(parts);
  DisjointSets sets(static_cast<std::size_t>(parts));
  for (const double step : steps) {
    for (const auto& [a, b] : links) {
      if (std::abs(levels[a] - levels[b]) <= step) sets.join(a, b);
    }
    tree.gather(sets);
  }
  for (int part = 1; part < parts; ++part) sets.join(0, part);
  tree.gather(sets);
  return tree.take();
}

}  // namespace

std::vector<int> PartHierarchy::root_path(int part) const {
  std::vector<int> path;
  for (int node = part; node >= 0; node = parents[static_cast<std::size_t>(node)]) path.push_back(node);
  return path;
}

PartHierarchy part_hierarchy(const Mesh& mesh, std::span<const int> labels, const Eigen::VectorXd& values,
                             const HierarchySettings& settings) {
  require(mesh, labels, values, settings);
  const std::vector<double> areas = face_areas(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(area > 0)) throw InputError("mesh", "it has no area", "give a mesh with a face of positive area");
  const int parts = *std::ranges::max_element(labels) + 1;
  const PartSummary summary = summary_of(areas, labels, parts, levels_of(values, area, settings.octaves), settings);

  PartHierarchy result;
  result.parts = parts;
  result.parents = tree_of(links_of(mesh, labels), summary.levels, settings.steps);
  result.histograms = Eigen::MatrixXd::Zero(result.nodes(), settings.bins);
  result.histograms.topRows(parts) = summary.histograms;
  for (int node = 0; node + 1 < result.nodes(); ++node) {  // parents come later
    result.histograms.row(result.parents[node]) += result.histograms.row(node);
  }
  return result;
}

}  // namespace partwise
