#include "partwise/parts/surface/continuous_visibility.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"
#include "partwise/geometry/inner_visibility.h"
#include "partwise/parts/surface/surface_graph.h"
#include "partwise/parts/surface/visible_regions.h"
#include "partwise/parts/surface/weak_visibility.h"

namespace partwise {
namespace {

std::int64_t weight_of(const SurfaceGraph& graph, const std::vector<int>& vertices) {
  std::int64_t sum = 0;
  for (const int v : vertices) sum += graph.weight[static_cast<std::size_t>(v)];
  return sum;
}

VisibilityMatrix all_regions(const SurfaceGraph& graph, const InnerVisibility& visibility, VisibilityMethod method,
                             const Progress& progress, std::uint64_t& tests) {
  VisibilityMatrix sees(graph.size());
  tests = for_each_region(graph, visibility, method, progress, [&](int viewpoint, const std::vector<int>& region) {
    std::vector<int> sorted = region;
    std::sort(sorted.begin(), sorted.end());
    sees.set_row(viewpoint, sorted);
  });
  return sees;
}

std::vector<double> row_areas(const SurfaceGraph& graph, const VisibilityMatrix& sees) {
  std::vector<double> values(static_cast<std::size_t>(graph.size()));
  tbb::parallel_for(0, graph.size(), [&](int v) { values[v] = graph.area_of(weight_of(graph, sees.row(v))); });
  return values;
}

// Section 2.2.4.3: with the value on the other side of the wall.
std::vector<double> averaged(const SurfaceGraph& graph, const InnerVisibility& visibility,
                             const std::vector<double>& values) {
  std::vector<double> result = values;
  for (int v = 0; v < graph.size(); ++v) {
    const int face = visibility.opposite_face(v);
    if (face < 0) continue;
    double across = 0;
    for (const int corner : graph.mesh.faces.row(face)) across += values[corner] / 3;
    result[v] = (values[v] + across) / 2;
  }
  return result;
}

std::vector<double> graph_values(const SurfaceGraph& graph, const VisibilitySettings& settings,
                                 const Progress& progress, std::uint64_t& tests) {
  const InnerVisibility visibility(graph.mesh);
  switch (settings.kind) {
    case VisibilityKind::strong:
      return row_areas(graph, all_regions(graph, visibility, settings.method, progress, tests).mutual());
    case VisibilityKind::weak:
      return row_areas(graph, weak_regions(graph, visibility, settings.weak_threshold, progress, tests).mutual());
    case VisibilityKind::cvf:
    case VisibilityKind::avg:
      break;
  }
  std::vector<double> values(static_cast<std::size_t>(graph.size()));
  tests =
      for_each_region(graph, visibility, settings.method, progress, [&](int viewpoint, const std::vector<int>& region) {
        values[viewpoint] = graph.area_of(weight_of(graph, region));
      });
  return settings.kind == VisibilityKind::avg ? averaged(graph, visibility, values) : values;
}

}  // namespace

VisibilityFeature continuous_visibility(const Mesh& mesh, const VisibilitySettings& settings,
                                        const Progress& progress) {
  if (!(settings.weak_threshold > 0) || !std::isfinite(settings.weak_threshold))
    throw InputError("weak_threshold", fmt::format("is {}", settings.weak_threshold), "give a positive share of R");
  const SurfaceGraph graph = surface_graph(mesh);
  VisibilityFeature feature;
  const std::vector<double> values = graph_values(graph, settings, progress, feature.tests);
  feature.values = Eigen::VectorXd::Zero(mesh.vertices.rows());
  for (Eigen::Index v = 0; v < feature.values.size(); ++v)
    if (const int number = graph.of_input[static_cast<std::size_t>(v)]; number >= 0) feature.values[v] = values[number];
  return feature;
}

VisibilityVectors visibility_vectors(const Mesh& mesh, VisibilityMethod method, const Progress& progress) {
  const SurfaceGraph graph = surface_graph(mesh);
  VisibilityVectors vectors;
  vectors.of_vertex = graph.of_input;
  vectors.sees = all_regions(graph, InnerVisibility(graph.mesh), method, progress, vectors.tests);
  return vectors;
}

Eigen::VectorXd face_means(const Mesh& mesh, const Eigen::VectorXd& vertex_values) {
  Eigen::VectorXd means(mesh.faces.rows());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    means[f] =
        (vertex_values[mesh.faces(f, 0)] + vertex_values[mesh.faces(f, 1)] + vertex_values[mesh.faces(f, 2)]) / 3;
  return means;
}

Eigen::VectorXd vertex_means(const Mesh& mesh, const Eigen::VectorXd& face_values) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(mesh.vertices.rows()), areas = sums;
  const std::vector<double> area = face_areas(mesh);
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (const int v : mesh.faces.row(f)) {
      sums[v] += area[static_cast<std::size_t>(f)] * face_values[f];
      areas[v] += area[static_cast<std::size_t>(f)];
    }
  }
  return (areas.array() > 0).select(sums.array() / areas.array(), 0);
}

}  // namespace partwise
