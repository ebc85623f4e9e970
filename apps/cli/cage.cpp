// partwise cage: partwise::make_cage with files.

#include "partwise/parts/applications/cage.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "named_places.h"
#include "options.h"
#include "partwise/geometry/mesh_io.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, cage, png;
  CageSettings settings;
};

void cage_of_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  run.outputs.add("--output", options.cage, {".obj", ".off", ".ply", ".stl", ".glb"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const Cage cage = naming_mesh(options.mesh, [&] { return make_cage(mesh, options.settings, run.progress); });
  for (const auto& [stage, seconds] : cage.seconds) run.seconds[stage] = seconds;
  run.stage("write", [&] {
    write_mesh(run.outputs.staged("--output"), cage.mesh);
    if (!options.png.empty()) write_cage_picture(run.outputs.staged("--png"), mesh, cage.mesh);
  });
  run.report["faces"] = cage.mesh.faces.rows();
  run.report["vertices"] = cage.mesh.vertices.rows();
  run.report["encloses"] = true;  // make_cage has tested it.
  run.report["watertight"] = true;
  run.report["parts"] = cage.parts;
  run.report["expansion"] = cage.expansion;
  run.report["volume"] = cage.volume;
  run.report["radius"] = cage.radius;
  run.report["input"] = options.mesh;
  const std::string written = run.report_files({{"output", options.cage}, {"png", options.png}});
  run.summary = fmt::format("{}: a cage of {} faces around {} part{}{}", options.mesh, cage.mesh.faces.rows(),
                            cage.parts, cage.parts == 1 ? "" : "s", written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  CageSettings& settings = options->settings;
  add_mesh(command, options->mesh);
  add_file(command, "-o,--output", options->cage, "Write the cage (.obj, .off, .ply, .stl or .glb)")->required();
  add_count(command, "--max-faces", settings.max_faces, 4, "At most N faces [300]");
  add_positive(command, "--tolerance", settings.tolerance,
               "Largest concavity of the parts that the cage follows, a share of R, the radius of the mesh's bounding "
               "sphere [0.1]");
  add_positive(command, "--expansion", settings.expansion,
               "How far the hulls of the parts are expanded, a share of R: more closes wider gaps [0.04]");
  add_file(command, "--png", options->png, "Draw the mesh inside the edges of its cage (.png)");
  return [options](Run& run) { cage_of_file(*options, run); };
}

}  // namespace

const Verb cage_verb = {
    .name = "cage",
    .summary = "A coarse closed surface around a mesh, to deform it by",
    .details =
        "The convex hulls of the mesh's parts, expanded, united and simplified outwards: watertight, with all of the\n"
        "mesh inside and few faces. partwise deform moves the mesh with it.",
    .example = "  partwise cage horse.ply -o horse_cage.obj --png horse_cage.png",
    .add = add,
};

}  // namespace partwise::cli
