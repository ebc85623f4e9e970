// partwise evaluate: partwise::SegmentationComparison with files.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "named_places.h"
#include "options.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/segmentation_measures.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, segmentation;
  std::vector<std::string> references;
};

using Field = std::pair<const char*, double SegmentationMeasures::*>;
constexpr std::array fields = {
    Field{"rand_error", &SegmentationMeasures::rand_error},
    Field{"cut_discrepancy", &SegmentationMeasures::cut_discrepancy},
    Field{"hamming", &SegmentationMeasures::hamming},
    Field{"hamming_missing", &SegmentationMeasures::hamming_missing},
    Field{"hamming_false", &SegmentationMeasures::hamming_false},
    Field{"consistency_global", &SegmentationMeasures::consistency_global},
    Field{"consistency_local", &SegmentationMeasures::consistency_local},
};

void put(const SegmentationMeasures& measures, nlohmann::ordered_json& json) {
  for (const auto& [name, field] : fields) {
    const double value = measures.*field;
    json[name] = std::isnan(value) ? nullptr : nlohmann::ordered_json(value);
  }
}

void report(const Options& options, const std::vector<SegmentationMeasures>& measures, Run& run) {
  const SegmentationMeasures mean = mean_measures(measures);
  put(mean, run.report);
  run.report["references"] = measures.size();
  nlohmann::ordered_json& each = run.report["by_reference"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < measures.size(); ++i) {
    each.push_back({{"reference", options.references[i]}});
    put(measures[i], each.back());
  }
  run.summary = fmt::format(
      "{} against {} reference{}: Rand error {:.4f}, cut discrepancy {}, Hamming {:.4f} (missing {:.4f}, false "
      "{:.4f}), "
      "consistency {:.4f} global, {:.4f} local",
      options.segmentation, measures.size(), measures.size() == 1 ? "" : "s", mean.rand_error,
      std::isnan(mean.cut_discrepancy) ? "undefined" : fmt::format("{:.4f}", mean.cut_discrepancy), mean.hamming,
      mean.hamming_missing, mean.hamming_false, mean.consistency_global, mean.consistency_local);
}

void evaluate_files(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  run.outputs.add_input("SEGMENTATION", options.segmentation);
  for (const std::string& reference : options.references) run.outputs.add_input("REFERENCE", reference);

  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const auto labels_of = [&](const std::string& file) {
    return run.stage("read", [&] {
      std::vector<int> labels = read_labels(file);
      require_label_per_face(mesh, labels, file);
      return labels;
    });
  };
  const std::vector<int> segmentation = labels_of(options.segmentation);
  const SegmentationComparison comparison = run.stage(
      "compare", [&] { return naming_mesh(options.mesh, [&] { return SegmentationComparison(mesh, segmentation); }); });
  std::vector<SegmentationMeasures> measures;
  for (const std::string& file : options.references) {
    const std::vector<int> reference = labels_of(file);
    measures.push_back(run.stage("compare", [&] { return comparison.against(reference); }));
  }
  report(options, measures, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  add_mesh(command, options->mesh);
  command.add_option("SEGMENTATION", options->segmentation, "The labels to judge, one a face (.seg)")
      ->required()
      ->type_name("");
  command.add_option("REFERENCE", options->references, "What they are compared with, one file or more (.seg)")
      ->required()
      ->type_name("");
  return [options](Run& run) { evaluate_files(*options, run); };
}

}  // namespace

const Verb evaluate_verb = {
    .name = "evaluate",
    .summary = "How far a segmentation is from others of the same mesh",
    .details =
        "Compares labels of faces with one or more references, people's for example, by the four measures of the\n"
        "Princeton benchmark (Chen, Golovinskiy, Funkhouser 2009), and gives their means. All are 0 for equal "
        "segmentations.\n"
        "  rand_error       share of the pairs of faces that are together in one and apart in the other\n"
        "  cut_discrepancy  mean distance between their borders, over the mean radius of the mesh;\n"
        "                   null where just one of the two has borders, and then left out of the mean\n"
        "  hamming          share of the area outside the best match of each part: hamming_missing for the\n"
        "                   parts of the reference, hamming_false for those of the segmentation, and their mean\n"
        "  consistency      how far neither refines the other: consistency_global, consistency_local\n"
        "Names of labels do not matter. --json has the means, references (how many) and by_reference (each).",
    .example =
        "  partwise decompose chair.off --tolerance 0.1 --labels chair.seg\n"
        "  partwise evaluate chair.off chair.seg people/chair_0.seg people/chair_1.seg\n"
        "  partwise evaluate chair.off chair.seg people/chair_*.seg --json -",
    .add = add,
};

}  // namespace partwise::cli
