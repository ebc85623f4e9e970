// partwise feature: partwise::continuous_visibility with files.

#include <fmt/format.h>

#include <memory>
#include <string>

#include "mesh_errors.h"
#include "options.h"
#include "partwise/base/atomic_file.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, values;
  VisibilitySettings settings;
};

const Choices<VisibilityKind> kinds = {{"cvf", VisibilityKind::cvf},
                                       {"cvf-avg", VisibilityKind::avg},
                                       {"cvf-strong", VisibilityKind::strong},
                                       {"cvf-weak", VisibilityKind::weak}};
const Choices<VisibilityMethod> methods = {{"filter", VisibilityMethod::filter},
                                           {"bfs", VisibilityMethod::bfs},
                                           {"bfs-plain", VisibilityMethod::bfs_plain},
                                           {"filter-printed", VisibilityMethod::filter_printed}};

void report(const Options& options, const VisibilityFeature& feature, Run& run) {
  nlohmann::ordered_json& json = run.report;
  json["visibility_tests"] = feature.tests;
  json["min"] = feature.values.minCoeff();
  json["max"] = feature.values.maxCoeff();
  json["mean"] = feature.values.mean();
  json["kind"] = name_of(kinds, options.settings.kind);
  if (options.settings.kind != VisibilityKind::weak) json["method"] = name_of(methods, options.settings.method);
  json["vertices"] = feature.values.size();
  json["input"] = options.mesh;
  run.summary =
      fmt::format("{}: {} of {} vertices, {:.6g} to {:.6g}, by {} visibility tests{}", options.mesh,
                  name_of(kinds, options.settings.kind), feature.values.size(), feature.values.minCoeff(),
                  feature.values.maxCoeff(), feature.tests, options.values.empty() ? "" : "\nwrote " + options.values);
}

void feature_of_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  if (!options.values.empty()) run.outputs.add("--values", options.values);
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const VisibilityFeature feature = run.stage("feature", [&] {
    return naming_mesh(options.mesh, [&] { return continuous_visibility(mesh, options.settings, run.progress); });
  });
  run.stage("write", [&] {
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
  add_choice(command, "--kind", settings.kind, kinds,
             "cvf: area that a vertex sees over visible paths; cvf-avg: its mean with the value on the other side of "
             "the wall; cvf-strong: what sees back; cvf-weak: over shortest paths that are hidden for little")
      ->required();
  const CLI::Option* method = add_choice(
      command, "--method", settings.method, methods,
      "filter: few tests, the same as bfs [default]; bfs: search in breadth; bfs-plain: without filling islands; "
      "filter-printed: as published");
  const CLI::Option* threshold =
      add_positive(command, "--weak-threshold", settings.weak_threshold,
                   "Of cvf-weak: the longest hidden part of a path, as a share of the bounding-sphere radius [0.1]");
  add_file(command, "--values", options->values, "Write the value of each vertex, one a line");
  return [options, method, threshold](Run& run) {
    const bool weak = options->settings.kind == VisibilityKind::weak;
    if (weak && method->count() > 0)
      throw UsageError("--method does not belong to --kind cvf-weak, which searches in a way of its own; leave it out");
    if (!weak && threshold->count() > 0) throw UsageError("--weak-threshold belongs to --kind cvf-weak; leave it out");
    feature_of_file(*options, run);
  };
}

}  // namespace

const Verb feature_verb = {
    .name = "feature",
    .summary = "The continuous visibility of each vertex of a mesh",
    .details =
        "How much of the surface each vertex sees through the solid, along paths that it sees all of: large in large\n"
        "convex parts, small in small ones and in hollows. Model units squared.",
    .example = "  partwise feature hand.off --kind cvf-avg --values hand.txt --json -",
    .add = add,
};

}  // namespace partwise::cli
