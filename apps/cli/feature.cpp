// partwise feature: partwise::continuous_visibility and partwise::shape_diameter with files.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "named_places.h"
#include "options.h"
#include "part_meshes.h"
#include "partwise/appearance/colouring.h"
#include "partwise/base/atomic_file.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/smoothing.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/shape_diameter.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, values, glb, png;
  std::optional<VisibilityKind> kind;  // none: the shape diameter
  VisibilitySettings settings;
  int smooth = 0;  // rounds
};

const Choices<std::optional<VisibilityKind>> kinds = {{"cvf", VisibilityKind::cvf},
                                                      {"cvf-avg", VisibilityKind::avg},
                                                      {"cvf-strong", VisibilityKind::strong},
                                                      {"cvf-weak", VisibilityKind::weak},
                                                      {"sdf", std::nullopt}};
const Choices<VisibilityMethod> methods = {{"filter", VisibilityMethod::filter},
                                           {"bfs", VisibilityMethod::bfs},
                                           {"bfs-plain", VisibilityMethod::bfs_plain},
                                           {"filter-printed", VisibilityMethod::filter_printed}};

// Values of the vertices, and by how many visibility tests.
VisibilityFeature values_of(const Mesh& input, const Options& options, const Progress& progress) {
  const Mesh mesh = options.smooth > 0 ? smoothed(input, options.smooth) : input;
  if (!options.kind) return {.values = vertex_means(mesh, shape_diameter(mesh, {}, progress).values), .tests = 0};
  VisibilitySettings settings = options.settings;
  settings.kind = *options.kind;
  return continuous_visibility(mesh, settings, progress);
}

void report(const Options& options, const VisibilityFeature& feature, Run& run) {
  const std::string kind = name_of(kinds, options.kind);
  nlohmann::ordered_json& json = run.report;
  json["visibility_tests"] = feature.tests;
  json["min"] = feature.values.minCoeff();
  json["max"] = feature.values.maxCoeff();
  json["mean"] = feature.values.mean();
  json["kind"] = kind;
  if (options.kind && options.kind != VisibilityKind::weak) json["method"] = name_of(methods, options.settings.method);
  if (options.smooth > 0) json["smooth"] = options.smooth;
  json["vertices"] = feature.values.size();
  json["input"] = options.mesh;
  const std::string written =
      run.report_files({{"values", options.values}, {"glb", options.glb}, {"png", options.png}});
  const std::string effort = options.kind ? fmt::format(", by {} visibility tests", feature.tests) : "";
  run.summary = fmt::format("{}: {} of {} vertices, {:.6g} to {:.6g}{}{}", options.mesh, kind, feature.values.size(),
                            feature.values.minCoeff(), feature.values.maxCoeff(), effort, written);
}

void feature_of_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  if (!options.values.empty()) run.outputs.add("--values", options.values);
  if (!options.glb.empty()) run.outputs.add("--glb", options.glb, {".glb"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const VisibilityFeature feature = run.stage(
      "feature", [&] { return naming_mesh(options.mesh, [&] { return values_of(mesh, options, run.progress); }); });
  run.stage("write", [&] {
    const Eigen::VectorXd of_faces = face_means(mesh, feature.values);
    if (!options.glb.empty()) write_meshes(run.outputs.staged("--glb"), value_meshes(mesh, of_faces));
    if (!options.png.empty()) write_picture(run.outputs.staged("--png"), coloured_by_value(mesh, of_faces));
    if (options.values.empty()) return;
    std::string lines;
    for (const double value : feature.values) lines += fmt::format("{}\n", value);
    write_file(run.outputs.staged("--values"), lines);
  });
  report(options, feature, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  VisibilitySettings& settings = options->settings;
  add_mesh(command, options->mesh);
  add_choice(command, "--kind", options->kind, kinds,
             "cvf: area that a vertex sees over visible paths; cvf-avg: its mean with the value on the other side of "
             "the wall; cvf-strong: what sees back; cvf-weak: over shortest paths that are hidden for little; sdf: "
             "shape diameter, how thick the solid is")
      ->required();
  const CLI::Option* method = add_choice(
      command, "--method", settings.method, methods,
      "filter: few tests, the same as bfs [default]; bfs: search in breadth; bfs-plain: without filling islands; "
      "filter-printed: as published");
  const CLI::Option* threshold =
      add_positive(command, "--weak-threshold", settings.weak_threshold,
                   "Of cvf-weak: the longest hidden part of a path, as a share of the bounding-sphere radius [0.1]");
  add_count(
      command, "--smooth", options->smooth, 0,
      "Of noisy meshes, scans for example: take the values from the surface after N rounds of smoothing (Taubin), "
      "10 for instance [0]");
  add_file(command, "--values", options->values, "Write the value of each vertex, one a line");
  add_file(command, "--glb", options->glb, "Write the mesh, coloured from dark blue, least, to yellow, most (.glb)");
  add_file(command, "--png", options->png, "Draw the mesh in the same colours (.png)");
  return [options, method, threshold](Run& run) {
    const bool searched = options->kind && options->kind != VisibilityKind::weak;
    if (!searched && method->count() > 0)
      throw UsageError(
          "--method does not belong to --kind cvf-weak or sdf, which have ways of their own; leave it out");
    if (options->kind != VisibilityKind::weak && threshold->count() > 0)
      throw UsageError("--weak-threshold belongs to --kind cvf-weak; leave it out");
    feature_of_file(*options, run);
  };
}

}  // namespace

const Verb feature_verb = {
    .name = "feature",
    .summary = "How large the part about each vertex of a mesh is: continuous visibility, or shape diameter",
    .details =
        "How much of the surface each vertex sees through the solid, along paths that it sees all of: large in large\n"
        "convex parts, small in small ones and in hollows. Model units squared; sdf in model units.",
    .example = "  partwise feature hand.off --kind cvf-avg --values hand.txt --png hand.png",
    .add = add,
};

}  // namespace partwise::cli
