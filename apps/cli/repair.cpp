// partwise repair: partwise::repair with files.

#include "partwise/parts/applications/repair.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "named_places.h"
#include "options.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, repaired, reference, png;
  RepairSettings settings;
};

Mesh read_reference(const std::string& file) {
  Mesh mesh = read_mesh(file);
  if (!is_watertight(mesh)) throw InputError(file, "the reference is not watertight", "give the intact mesh");
  return mesh;
}

void repair_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  if (!options.reference.empty()) run.outputs.add_input("--reference", options.reference);
  run.outputs.add("--output", options.repaired, {".obj", ".off", ".ply", ".stl", ".glb"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  std::optional<Mesh> intact;
  if (!options.reference.empty()) intact = run.stage("read", [&] { return read_reference(options.reference); });
  const Repair result = naming_mesh(options.mesh, [&] { return repair(mesh, options.settings, run.progress); });
  for (const auto& [stage, seconds] : result.seconds) run.seconds[stage] = seconds;
  run.report["watertight"] = true;  // repair has checked it.
  run.report["faces"] = result.mesh.faces.rows();
  run.report["parts"] = result.parts;
  run.report["tolerance"] = options.settings.tolerance;
  run.report["reach"] = result.reach;
  run.report["radius"] = result.radius;
  std::string loss_text;
  if (intact) {
    const RepairLoss loss = run.stage("compare", [&] { return repair_loss(result.mesh, *intact, run.progress); });
    run.report["added"] = loss.added;
    run.report["lost"] = loss.lost;
    run.report["volume_added"] = loss.volume_added;
    run.report["volume_lost"] = loss.volume_lost;
    loss_text =
        fmt::format("\nfrom {}: at most {:.3g} R outside of it, {:.3g} R of it lost; volume +{:.1f} %, -{:.1f} %",
                    options.reference, loss.added, loss.lost, 100 * loss.volume_added, 100 * loss.volume_lost);
  }
  run.stage("write", [&] {
    write_mesh(run.outputs.staged("--output"), result.mesh);
    if (!options.png.empty()) write_picture(run.outputs.staged("--png"), PreviewMesh{result.mesh, {}});
  });
  run.report["input"] = options.mesh;
  const std::string written = run.report_files({{"output", options.repaired}, {"png", options.png}});
  const bool strays = result.reach > options.settings.tolerance;
  run.summary =
      fmt::format("{}: watertight, {} faces from {} parts, at most {:.3g} R from what was given{}{}{}", options.mesh,
                  result.mesh.faces.rows(), result.parts, result.reach,
                  strays ? ", MORE than the tolerance: it is too small for what is missing" : "", loss_text, written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  RepairSettings& settings = options->settings;
  add_mesh(command, options->mesh);
  add_file(command, "-o,--output", options->repaired, "Write the watertight mesh (.obj, .off, .ply, .stl or .glb)")
      ->required();
  add_positive(command, "--tolerance", settings.tolerance,
               "How far the result may stray, a share of R, the radius of the mesh's bounding sphere: less keeps more "
               "detail and closes narrower gaps [0.1]");
  add_count(command, "--max-faces", settings.max_faces, 100, "At most N faces [20000]");
  add_file(command, "--reference", options->reference,
           "The intact mesh: report what was lost and what was added, distances and volumes");
  add_file(command, "--png", options->png, "Draw the result (.png)");
  return [options](Run& run) { repair_file(*options, run); };
}

}  // namespace

const Verb repair_verb = {
    .name = "repair",
    .summary = "A watertight mesh from a broken one",
    .details =
        "The convex hulls of the parts of a mesh with holes or many faces missing, united into one closed surface.\n"
        "Detail below the tolerance goes.",
    .example = "  partwise repair scan.ply -o whole.obj --tolerance 0.05 --png whole.png",
    .add = add,
};

}  // namespace partwise::cli
