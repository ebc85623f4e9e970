// partwise decompose: partwise::decompose with files.

#include "partwise/parts/solid/decompose.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "named_places.h"
#include "options.h"
#include "part_meshes.h"
#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/solid/robot_files.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh;
  DecompositionSettings settings;
  std::string labels, hulls, glb, urdf, mjcf;
};

const char* measure_name(ConcavityMeasure measure) { return measure == ConcavityMeasure::hull ? "hull" : "valley"; }

void check_usage(const DecompositionSettings& settings) {
  if (settings.cup_repair && settings.measure != ConcavityMeasure::valley)
    throw UsageError("--cup-repair belongs to --measure valley; leave it out, hull cuts cups anyway");
}

void announce_outputs(const Options& options, Outputs& outputs) {
  outputs.add_input("MESH", options.mesh);
  if (!options.labels.empty()) outputs.add("--labels", options.labels);
  if (!options.hulls.empty()) outputs.add("--hulls", options.hulls, {".obj", ".glb"});
  if (!options.glb.empty()) outputs.add("--glb", options.glb, {".glb"});
  if (!options.urdf.empty()) outputs.add("--urdf", options.urdf, {".urdf"});
  if (!options.mjcf.empty()) outputs.add("--mjcf", options.mjcf, {".xml", ".mjcf"});
}

void check_promise(const Options& options, const Decomposition& result) {
  if (options.settings.max_hulls > 0 || result.concavity <= result.tolerance) return;
  throw InputError(options.mesh,
                   fmt::format("the parts reach a concavity of {:.6g}, above the tolerance of {:.6g}", result.concavity,
                               result.tolerance),
                   options.settings.max_hull_vertices > 0
                       ? "allow more vertices a hull, or a larger tolerance"
                       : "ask for a larger tolerance, or accept it with --max-hulls");
}

void write_outputs(const Options& options, const Mesh& mesh, const Decomposition& result, Outputs& outputs) {
  if (!options.labels.empty()) write_labels(outputs.staged("--labels"), result.labels);
  if (!options.hulls.empty()) write_meshes(outputs.staged("--hulls"), hull_meshes(result.hulls));
  if (!options.glb.empty()) {
    write_meshes(outputs.staged("--glb"), part_meshes(result.mesh, result.mesh_labels, result.parts()));
  }
  if (options.urdf.empty() && options.mjcf.empty()) return;
  const std::string name = std::filesystem::path(options.mesh).stem().string();
  const RobotBody body{.name = name, .hulls = result.hulls, .visual = &mesh, .mass = body_mass(mesh, result.hulls)};
  if (!options.urdf.empty()) write_urdf(outputs.staged("--urdf"), body);
  if (!options.mjcf.empty()) write_mjcf(outputs.staged("--mjcf"), body);
}

void report(const Options& options, const Decomposition& result, Run& run) {
  nlohmann::ordered_json& json = run.report;
  json["parts"] = result.parts();
  json["tolerance"] = result.tolerance;
  json["concavity"] = result.concavity;
  json["volume_ratio"] = std::isfinite(result.volume_ratio) ? nlohmann::ordered_json(result.volume_ratio) : nullptr;
  json["watertight"] = result.watertight;
  json["radius"] = result.radius;
  json["measure"] = measure_name(options.settings.measure);
  json["absolute"] = options.settings.absolute;
  json["cut_inside"] = result.cut_inside;
  json["faces"] = result.labels.size();
  json["input"] = options.mesh;
  const std::string written = run.report_files({{"labels", options.labels},
                                                {"hulls", options.hulls},
                                                {"glb", options.glb},
                                                {"urdf", options.urdf},
                                                {"mjcf", options.mjcf}});
  const char* unit = options.settings.absolute ? "" : " R";
  const std::string ratio = std::isfinite(result.volume_ratio)
                                ? fmt::format(", union of hulls {:.4g} x the volume", result.volume_ratio)
                                : "";
  run.summary = fmt::format("{}: {} part{}, concavity {:.4g}{} (tolerance {:.4g}{}, {}){}{}", options.mesh,
                            result.parts(), result.parts() == 1 ? "" : "s", result.concavity, unit, result.tolerance,
                            unit, measure_name(options.settings.measure), ratio, written);
}

void decompose_files(const Options& options, Run& run) {
  check_usage(options.settings);
  announce_outputs(options, run.outputs);
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const Decomposition result =
      naming_mesh(options.mesh, [&] { return decompose(mesh, options.settings, run.progress); });
  for (const auto& [stage, seconds] : result.seconds) run.seconds[stage] = seconds;
  check_promise(options, result);
  run.stage("write", [&] { write_outputs(options, mesh, result, run.outputs); });
  report(options, result, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  DecompositionSettings& settings = options->settings;
  add_mesh(command, options->mesh);
  add_positive(command, "--tolerance", settings.tolerance,
               "Largest concavity of a part, as a share of R, the radius of the mesh's bounding sphere; 0.1 is coarse, "
               "0.02 fine")
      ->required();
  command.add_flag("--absolute", settings.absolute, "T is in model units");
  add_choice(command, "--measure", settings.measure,
             Choices<ConcavityMeasure>{{"hull", ConcavityMeasure::hull}, {"valley", ConcavityMeasure::valley}},
             "hull: no hull leaves the solid by more than T [default]; valley: no valley between hull edges is deeper "
             "than T, as published");
  command.add_flag("--cup-repair", settings.cup_repair,
                   "With --measure valley: lead valleys through hollows, so that cups are cut (section 2.4.8)");
  add_count(command, "--max-hulls", settings.max_hulls, 1,
            "At most N parts; T may then be exceeded, and concavity says by how much");
  add_count(command, "--max-hull-vertices", settings.max_hull_vertices, 4, "At most N vertices a hull, 4 or more");
  add_file(command, "--labels", options->labels, "Write the part of each face, one a line (.seg)");
  add_file(command, "--hulls", options->hulls, "Write the hulls, one object a part (.obj or .glb)");
  add_file(command, "--glb", options->glb, "Write the parts, cut and coloured, one node each (.glb)");
  add_file(command, "--urdf", options->urdf, "Write a robot of one link (.urdf), its hulls beside it in NAME_hulls/");
  add_file(command, "--mjcf", options->mjcf, "Write a MuJoCo body (.xml), its hulls beside it in NAME_hulls/");
  return [options](Run& run) { decompose_files(*options, run); };
}

}  // namespace

const Verb decompose_verb = {
    .name = "decompose",
    .summary = "Nearly convex parts of a mesh, and their convex hulls",
    .details =
        "Cuts a mesh into nearly convex parts, each with a convex hull that encloses it.\n"
        "One number decides: the tolerance, the largest concavity that a part may keep.",
    .example =
        "  partwise decompose chair.off --tolerance 0.1 --hulls chair_hulls.obj --glb chair_parts.glb\n"
        "  partwise decompose chair.off --tolerance 0.05 --max-hull-vertices 60 --urdf chair.urdf --json -",
    .add = add,
};

}  // namespace partwise::cli
