// partwise segment: partwise::segment with files.

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "named_places.h"
#include "options.h"
#include "part_meshes.h"
#include "partwise/appearance/colouring.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/segmentation.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, labels, glb, png;
  SegmentationSettings settings;
};

const Choices<SurfaceFeature> features = {{"cvf", SurfaceFeature::visibility},
                                          {"cvf-avg", SurfaceFeature::visibility_average},
                                          {"cvf-strong", SurfaceFeature::visibility_strong},
                                          {"cvf-weak", SurfaceFeature::visibility_weak},
                                          {"sdf", SurfaceFeature::shape_diameter}};

const Choices<Borders> borders = {
    {"automatic", Borders::automatic}, {"plain", Borders::plain}, {"learnt", Borders::learnt}};

void report(const Options& options, const Segmentation& result, Run& run) {
  nlohmann::ordered_json& json = run.report;
  json["parts"] = result.parts;
  json["clusters"] = result.clusters;
  json["smoothness"] = result.smoothness;
  json["borders"] = name_of(borders, result.borders);
  json["feature"] = name_of(features, options.settings.feature);
  json["faces"] = result.labels.size();
  json["input"] = options.mesh;
  const std::string written =
      run.report_files({{"labels", options.labels}, {"glb", options.glb}, {"png", options.png}});
  const std::string how = result.borders == Borders::learnt
                              ? "learnt borders"
                              : fmt::format("{} clusters, smoothness {:.4g}", result.clusters, result.smoothness);
  run.summary = fmt::format("{}: {} part{} by {} ({}){}", options.mesh, result.parts, result.parts == 1 ? "" : "s",
                            name_of(features, options.settings.feature), how, written);
}

void segment_files(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  if (!options.labels.empty()) run.outputs.add("--labels", options.labels);
  if (!options.glb.empty()) run.outputs.add("--glb", options.glb, {".glb"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  SegmentationSettings settings = options.settings;
  settings.seed = run.seed;
  const Segmentation result = naming_mesh(options.mesh, [&] { return segment(mesh, settings, run.progress); });
  for (const auto& [stage, seconds] : result.seconds) run.seconds[stage] = seconds;
  run.stage("write", [&] {
    if (!options.labels.empty()) write_labels(run.outputs.staged("--labels"), result.labels);
    if (!options.glb.empty()) write_meshes(run.outputs.staged("--glb"), part_meshes(mesh, result.labels, result.parts));
    if (!options.png.empty()) {
      write_picture(run.outputs.staged("--png"), coloured_by_part(mesh, result.labels));
    }
  });
  report(options, result, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  SegmentationSettings& settings = options->settings;
  add_mesh(command, options->mesh);
  add_choice(
      command, "--feature", settings.feature, features,
      "cvf-avg: area that is continuously visible, averaged with the other side of the wall, the closest to people; "
      "cvf, "
      "cvf-strong, cvf-weak: its other kinds (see partwise feature); sdf: shape diameter, how thick the solid is")
      ->required();
  add_choice(
      command, "--borders", settings.borders, borders,
      "learnt: pieces are merged across borders that people would not draw, with cvf-avg alone; plain: levels of the "
      "feature are cut apart, by --clusters and --smoothness; automatic: learnt where it can be, unless one of "
      "these two is given");
  add_count(command, "--clusters", settings.clusters, 1,
            "Levels of the feature that are told apart; left out: what was fitted to people's segmentations");
  add_positive(command, "--smoothness", settings.smoothness,
               "How dear borders between parts are; more gives fewer parts; left out: what was fitted");
  add_file(command, "--labels", options->labels, "Write the part of each face, one a line (.seg)");
  add_file(command, "--glb", options->glb, "Write the parts, coloured, one node each (.glb)");
  add_file(command, "--png", options->png, "Draw the mesh in the colours of its parts (.png)");
  return [options](Run& run) { segment_files(*options, run); };
}

}  // namespace

const Verb segment_verb = {
    .name = "segment",
    .summary = "Parts of a mesh as people would cut it, from a feature of its surface",
    .details =
        "Computes a feature of the surface, clusters its values, and cuts between the clusters where the surface "
        "bends;\nwith cvf-avg the pieces are then merged where people would draw no border.\n"
        "Every part is connected; one cluster may give many parts (the legs of a chair).",
    .example =
        "  partwise segment chair.off --feature cvf-avg --labels chair.seg --png chair_parts.png\n"
        "  partwise segment chair.off --feature cvf-avg --clusters 3 --smoothness 20 --json -",
    .add = add,
};

}  // namespace partwise::cli
