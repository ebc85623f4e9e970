#include "partwise/parts/surface/segmentation_measures.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/parts/surface/contingency_table.h"

namespace partwise {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// As the benchmark has it: a face stands in its centroid.
double mean_radius(const Mesh& mesh, const std::vector<double>& areas, double total) {
  const auto centroid_of = [&](Eigen::Index f) -> Point {
    return (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
            mesh.vertices.row(mesh.faces(f, 2))) /
           3;
  };
  Point centroid = Point::Zero();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) centroid += areas[f] / total * centroid_of(f);
  double radius = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    radius += areas[f] / total * (centroid_of(f) - centroid).norm();
  }
  return radius;
}

void require_count(std::size_t faces, std::span<const int> labels, const std::string& place) {
  if (labels.size() == faces) return;
  throw InputError(place, fmt::format("{} labels for a mesh of {} faces", labels.size(), faces),
                   "give one label a face, in the order of the faces");
}

}  // namespace

void require_label_per_face(const Mesh& mesh, std::span<const int> labels, const std::string& place) {
  require_count(static_cast<std::size_t>(mesh.faces.rows()), labels, place);
}

SegmentationComparison::SegmentationComparison(const Mesh& mesh, std::span<const int> segmentation)
    : vertices_(mesh.vertices), areas_(face_areas(mesh)), segmentation_(segmentation.begin(), segmentation.end()) {
  require_label_per_face(mesh, segmentation, "segmentation");
  double total = 0;
  for (const double area : areas_) total += area;
  if (!(total > 0) || !std::isfinite(total)) {
    throw InputError("mesh", fmt::format("its area is {}", total), "give a mesh with at least one proper triangle");
  }
  mean_radius_ = mean_radius(mesh, areas_, total);
  half_edges_ = sorted_half_edges(mesh);
  add_steps();
  cut_ = cut_vertices(segmentation_);
  from_cut_ = path_lengths(cut_);
}

void SegmentationComparison::add_steps() {
  first_.assign(static_cast<std::size_t>(vertices_.rows()) + 1, 0);
  for_each_edge(half_edges_, [&](std::span<const HalfEdge> edge) {
    ++first_[edge[0].low + 1];
    ++first_[edge[0].high + 1];
  });
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  steps_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_edge(half_edges_, [&](std::span<const HalfEdge> edge) {
    const int a = edge[0].low, b = edge[0].high;
    const double length = (vertices_.row(a) - vertices_.row(b)).norm();
    steps_[next[a]++] = {b, length};
    steps_[next[b]++] = {a, length};
  });
}

std::vector<int> SegmentationComparison::cut_vertices(std::span<const int> labels) const {
  std::vector<char> is_on_cut(static_cast<std::size_t>(vertices_.rows()), 0);
  for_each_edge(half_edges_, [&](std::span<const HalfEdge> edge) {
    const auto differs = [&](const HalfEdge& half) { return labels[half.face] != labels[edge[0].face]; };
    if (std::ranges::any_of(edge, differs)) is_on_cut[edge[0].low] = is_on_cut[edge[0].high] = 1;
  });
  std::vector<int> vertices;
  for (std::size_t v = 0; v < is_on_cut.size(); ++v) {
    if (is_on_cut[v]) vertices.push_back(static_cast<int>(v));
  }
  return vertices;
}

// Dijkstra (1959) from all sources at once.
std::vector<double> SegmentationComparison::path_lengths(const std::vector<int>& sources) const {
  std::vector<double> lengths(static_cast<std::size_t>(vertices_.rows()), infinite);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const int source : sources) {
    lengths[source] = 0;
    open.emplace(0, source);
  }
  while (!open.empty()) {
    const auto [length, vertex] = open.top();
    open.pop();
    if (length > lengths[vertex]) continue;
    for (int i = first_[vertex]; i < first_[vertex + 1]; ++i) {
      const double longer = length + steps_[i].length;
      if (longer >= lengths[steps_[i].to]) continue;
      lengths[steps_[i].to] = longer;
      open.emplace(longer, steps_[i].to);
    }
  }
  return lengths;
}

double SegmentationComparison::total_distance(const std::vector<int>& vertices, const std::vector<double>& lengths,
                                              const std::vector<int>& cut) const {
  double total = 0;
  for (const int vertex : vertices) {
    double distance = lengths[vertex];
    if (distance == infinite) {
      for (const int other : cut) distance = std::min(distance, (vertices_.row(vertex) - vertices_.row(other)).norm());
    }
    total += distance;
  }
  return total;
}

double SegmentationComparison::cut_discrepancy(std::span<const int> reference) const {
  const std::vector<int> cut = cut_vertices(reference);
  if (cut.empty() && cut_.empty()) return 0;
  if (cut.empty() || cut_.empty()) return undefined;
  const double total = total_distance(cut_, path_lengths(cut), cut) + total_distance(cut, from_cut_, cut_);
  if (total == 0) return 0;  // even where all faces have the same centroid
  return total / static_cast<double>(cut.size() + cut_.size()) / mean_radius_;
}

SegmentationMeasures SegmentationComparison::against(std::span<const int> reference) const {
  require_count(segmentation_.size(), reference, "reference");
  const ContingencyTable table = contingency_table(segmentation_, reference, areas_);
  const Unmatched unmatched = unmatched_area(table);
  const Consistency consistency = consistency_error(table);
  return {.rand_error = rand_error(table),
          .cut_discrepancy = cut_discrepancy(reference),
          .hamming = (unmatched.rows + unmatched.columns) / 2,
          .hamming_missing = unmatched.columns,
          .hamming_false = unmatched.rows,
          .consistency_global = consistency.global,
          .consistency_local = consistency.local};
}

SegmentationMeasures compare_segmentations(const Mesh& mesh, std::span<const int> segmentation,
                                           std::span<const int> reference) {
  require_label_per_face(mesh, reference, "reference");
  return SegmentationComparison(mesh, segmentation).against(reference);
}

SegmentationMeasures mean_measures(std::span<const SegmentationMeasures> measures) {
  if (measures.empty()) throw InputError("references", "there are none", "give at least one");
  const auto mean = [&](double SegmentationMeasures::*field) {
    double sum = 0;
    int defined = 0;
    for (const SegmentationMeasures& one : measures) {
      if (std::isnan(one.*field)) continue;
      sum += one.*field;
      ++defined;
    }
    return defined > 0 ? sum / defined : undefined;
  };
  using Fields = SegmentationMeasures;
  return {.rand_error = mean(&Fields::rand_error),
          .cut_discrepancy = mean(&Fields::cut_discrepancy),
          .hamming = mean(&Fields::hamming),
          .hamming_missing = mean(&Fields::hamming_missing),
          .hamming_false = mean(&Fields::hamming_false),
          .consistency_global = mean(&Fields::consistency_global),
          .consistency_local = mean(&Fields::consistency_local)};
}

}  // namespace partwise
