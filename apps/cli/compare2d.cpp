// partwise compare2d: measures of section 2.3.4.2 with files.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "options.h"
#include "partwise/base/error.h"
#include "partwise/parts/planar/read_segmentation.h"
#include "partwise/parts/planar/segmentation_measures.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string judged;
  std::vector<std::string> references;
  int grid = 200;
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void compare_files(const Options& options, Run& run) {
  std::vector<PlanarSegmentation> parts;
  run.stage("read", [&] {
    parts.push_back(read_segmentation(options.judged));
    for (const std::string& reference : options.references) parts.push_back(read_segmentation(reference));
  });
  Eigen::AlignedBox2d box;
  for (const PlanarSegmentation& each : parts) box.extend(bounding_box(each.polygons));
  if (box.isEmpty() || !(box.sizes().minCoeff() > 0)) {
    throw InputError(options.judged, "encloses nothing", "give decompositions as polygons or label images");
  }
  std::vector<double> to_each;
  double to_representative = 0, coverage = 0;
  std::size_t clusters = 0;
  run.stage("compare", [&] {
    std::vector<LabelGrid> grids;
    std::vector<std::vector<CutLine>> cuts;
    for (const PlanarSegmentation& each : parts) {
      grids.push_back(label_grid(each.polygons, box.min(), box.max(), options.grid, each.part));
      cuts.push_back(cut_lines(each.polygons));
    }
    for (std::size_t r = 1; r < grids.size(); ++r) to_each.push_back(rand_index(grids[0], grids[r]));
    const auto clustered = cluster_cuts(std::span(cuts).subspan(1), run.seed);
    clusters = clustered.size();
    to_representative = rand_index(grids[0], representative_grid(grids[1], clustered));
    coverage = cluster_coverage(cuts[0], clustered, 0.05 * box.sizes().norm());
  });
  run.report["rand_index"] = mean(to_each);
  run.report["cluster_coverage"] = coverage;
  run.report["rand_index_representative"] = to_representative;
  run.report["rand_index_each"] = to_each;
  run.report["clusters"] = clusters;
  run.report["input"] = options.judged;
  run.report["references"] = options.references;
  run.summary = fmt::format("{}: Rand index {:.4f}, cluster coverage {:.4f} (against {} decomposition{})",
                            options.judged, mean(to_each), coverage, to_each.size(), to_each.size() == 1 ? "" : "s");
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("A", options->judged,
                  "The decomposition to judge: polygons (.geojson, .json, .wkt, .svg, .poly) or a label image (.png)")
      ->required()
      ->type_name("");
  command.add_option("B", options->references, "What it is compared with, one or more")->required()->type_name("");
  add_count(command, "--grid", options->grid, 2, "Cells along a side of the grid [200]");
  return [options](Run& run) { compare_files(*options, run); };
}

}  // namespace

const Verb compare2d_verb = {
    "compare2d", "Compare decompositions of a shape in the plane",
    "Rand index: the share of pairs of grid cells that both put into one part, or both into two; the mean over all B, "
    "and "
    "against the parts that representative cuts make. Cluster coverage: the share of the cuts of all B, clustered by "
    "k-means, whose cluster has a cut of A. Label images: one colour or grey level a part, black or transparent is no "
    "part; coordinates in pixels, y down.",
    "  partwise compare2d mine.geojson human_1.geojson human_2.png", add};

}  // namespace partwise::cli
