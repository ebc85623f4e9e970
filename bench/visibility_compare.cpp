// Do the ways of finding continuously visible regions find the same?
//
//   visibility_compare MESH [--threads N]
//
// Finds the region of every vertex by each method (parts/surface/visible_region.h) and compares it with that of `bfs`,
// vertex by vertex. Prints one JSON object: for each method `tests`, the rays that it asked for, each for a pair of
// vertices and at most once a viewpoint and pair; how many vertices have another region (`regions_differ`) or another
// value (`values_differ`), the means over all vertices of the value's relative difference (`difference`) and of the
// vertices in one region but not in the other over those of bfs (`vertices_differ`). The value of a region, its area,
// is added up here from the faces. Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "bench/tool.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/continuous_visibility.h"

namespace {

using nlohmann::ordered_json;
using partwise::VisibilityMethod;

constexpr std::pair<const char*, VisibilityMethod> kMethods[] = {{"filter", VisibilityMethod::filter},
                                                                 {"filter-printed", VisibilityMethod::filter_printed},
                                                                 {"bfs-plain", VisibilityMethod::bfs_plain}};

// A third of the area of the faces at each vertex, by the numbers of the regions.
std::vector<double> vertex_areas(const partwise::Mesh& mesh, const partwise::VisibilityVectors& vectors) {
  std::vector<double> sums(static_cast<std::size_t>(vectors.sees.size()));
  const std::vector<double> areas = partwise::face_areas(mesh);
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (const int v : mesh.faces.row(f))
      sums[vectors.of_vertex[static_cast<std::size_t>(v)]] += areas[static_cast<std::size_t>(f)] / 3;
  return sums;
}

double area_of(const std::vector<int>& region, const std::vector<double>& areas) {
  double sum = 0;
  for (const int v : region) sum += areas[static_cast<std::size_t>(v)];
  return sum;
}

ordered_json compared(const partwise::VisibilityVectors& vectors, const partwise::VisibilityVectors& reference,
                      const std::vector<double>& areas) {
  int regions_differ = 0, values_differ = 0;
  double difference = 0, vertices_differ = 0;
  for (int v = 0; v < reference.sees.size(); ++v) {
    const std::vector<int> ours = vectors.sees.row(v), theirs = reference.sees.row(v);
    if (ours == theirs) continue;
    ++regions_differ;
    std::vector<int> apart;
    std::set_symmetric_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(), std::back_inserter(apart));
    vertices_differ += static_cast<double>(apart.size()) / static_cast<double>(theirs.size());
    const double value = area_of(ours, areas), expected = area_of(theirs, areas);
    values_differ += value != expected;
    if (expected > 0) difference += std::abs(value / expected - 1);
  }
  const int size = reference.sees.size();
  return {{"tests", vectors.tests},
          {"regions_differ", regions_differ},
          {"values_differ", values_differ},
          {"difference", difference / size},
          {"vertices_differ", vertices_differ / size}};
}

}  // namespace

int main(int argc, char** argv) {
  std::string path;
  int threads = 1;
  CLI::App app("Do the ways of finding continuously visible regions find the same?");
  app.add_option("mesh", path, "any mesh that the library reads")->required();
  app.add_option("--threads", threads)->check(CLI::PositiveNumber);
  return partwise::bench::run_tool("visibility_compare", app, argc, argv, [&] {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const partwise::Mesh mesh = partwise::read_mesh(path);
    const partwise::VisibilityVectors bfs = partwise::visibility_vectors(mesh, VisibilityMethod::bfs);
    const std::vector<double> areas = vertex_areas(mesh, bfs);
    ordered_json methods = {{"bfs", {{"tests", bfs.tests}}}};
    for (const auto& [name, method] : kMethods)
      methods[name] = compared(partwise::visibility_vectors(mesh, method), bfs, areas);
    std::cout << ordered_json{{"mesh", path}, {"vertices", bfs.sees.size()}, {"methods", methods}}.dump() << '\n';
    return 0;
  });
}
