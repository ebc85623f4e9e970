// partwise deform: partwise::CageDeformer with files.

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "named_places.h"
#include "options.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/applications/cage_deformer.h"
#include "partwise/parts/applications/cage_moves.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, cage, moves, deformed, moved_cage, png;
  CageCoordinates coordinates = CageCoordinates::green;
};

const Choices<CageCoordinates>& coordinate_names() {
  static const Choices<CageCoordinates> names{{"green", CageCoordinates::green},
                                              {"mean-value", CageCoordinates::mean_value}};
  return names;
}

// The library says "cage" of what is a file here.
CageDeformer deformer_of(const Options& options, const Mesh& mesh, const Mesh& cage, const Progress& progress) {
  try {
    return naming_mesh(options.mesh, [&] { return CageDeformer(mesh.vertices, cage, options.coordinates, progress); });
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (!text.starts_with("cage: ")) throw;
    const std::size_t remedy = text.find("; ");
    throw InputError(options.cage, text.substr(6, remedy - 6), text.substr(remedy + 2));
  }
}

void deform_files(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  run.outputs.add_input("CAGE", options.cage);
  run.outputs.add_input("MOVES", options.moves);
  run.outputs.add("--output", options.deformed, {".obj", ".off", ".ply", ".stl", ".glb"});
  if (!options.moved_cage.empty()) run.outputs.add("--cage", options.moved_cage, {".obj", ".off", ".ply"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  Mesh cage = run.stage("read", [&] { return read_mesh(options.cage); });
  Vertices moved = run.stage("read", [&] { return read_cage_moves(options.moves, cage); });
  const double radius = bounding_sphere(mesh).radius;
  const CageDeformer deformer =
      run.stage("coordinates", [&] { return deformer_of(options, mesh, cage, run.progress); });
  const double identity = run.stage(
      "check", [&] { return (deformer.deformed(cage.vertices) - mesh.vertices).rowwise().norm().maxCoeff(); });
  const auto farthest = (moved - cage.vertices).rowwise().norm().maxCoeff();
  mesh.vertices = run.stage("deform", [&] { return deformer.deformed(moved); });
  cage.vertices = std::move(moved);
  run.stage("write", [&] {
    write_mesh(run.outputs.staged("--output"), mesh);
    if (!options.moved_cage.empty()) write_mesh(run.outputs.staged("--cage"), cage);
    if (!options.png.empty()) write_cage_picture(run.outputs.staged("--png"), mesh, cage);
  });
  run.report["vertices"] = mesh.vertices.rows();
  run.report["coordinates"] = name_of(coordinate_names(), options.coordinates);
  run.report["identity_error"] = identity / radius;
  run.report["largest_move"] = farthest;
  run.report["radius"] = radius;
  run.report["input"] = options.mesh;
  const std::string written =
      run.report_files({{"output", options.deformed}, {"cage", options.moved_cage}, {"png", options.png}});
  run.summary = fmt::format("{}: {} vertices moved by {} of a cage{}", options.mesh, mesh.vertices.rows(),
                            cage.vertices.rows(), written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  add_mesh(command, options->mesh);
  add_file(command, "CAGE", options->cage, "A closed mesh around it, as partwise cage writes it")->required();
  add_file(command, "MOVES", options->moves, "What happens to the vertices of the cage (.json, docs/cage.md)")
      ->required();
  add_file(command, "-o,--output", options->deformed, "Write the deformed mesh (.obj, .off, .ply, .stl or .glb)")
      ->required();
  add_choice(command, "--coordinates", options->coordinates, coordinate_names(),
             "green: details keep their shape; exact for moves, turns and uniform scales of the cage [default]; "
             "mean-value: exact for all affine maps, details shear with the cage");
  add_file(command, "--cage", options->moved_cage, "Write the cage as it was moved (.obj, .off or .ply)");
  add_file(command, "--png", options->png, "Draw the deformed mesh inside the edges of its cage (.png)");
  return [options](Run& run) { deform_files(*options, run); };
}

}  // namespace

const Verb deform_verb = {
    .name = "deform",
    .summary = "A mesh deformed by the vertices of a cage around it",
    .details =
        "A small JSON file says which vertices of the cage are moved, turned or scaled; the mesh follows, by Green\n"
        "coordinates or by mean value coordinates.",
    .example =
        "  partwise cage horse.ply -o horse_cage.obj\n"
        "  echo '{\"handles\": [{\"near\": [0, 170, 120], \"within\": 60, \"move\": [0, 40, 0]}]}' > moves.json\n"
        "  partwise deform horse.ply horse_cage.obj moves.json -o stretched_horse.obj",
    .add = add,
};

}  // namespace partwise::cli
