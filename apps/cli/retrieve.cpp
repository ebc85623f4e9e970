// partwise retrieve: partwise::similar_parts over a folder of meshes.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "named_places.h"
#include "options.h"
#include "part_meshes.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/part_database.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string query, database, index, glb;
  int part = 0;
  int top = 9;
  bool others = false;
};

// What is searched: the whole database, or all but the query's own mesh.
std::vector<const DatabaseMesh*> searched(const PartDatabase& database, std::uint64_t query, bool others) {
  std::vector<const DatabaseMesh*> meshes;
  for (const DatabaseMesh& mesh : database.meshes) {
    if (!others || mesh.content != query) meshes.push_back(&mesh);
  }
  return meshes;
}

void report(const Options& options, const PartDatabase& database, const std::vector<const DatabaseMesh*>& meshes,
            const std::vector<PartMatch>& matches, Run& run) {
  nlohmann::ordered_json& json = run.report;
  json["matches"] = nlohmann::ordered_json::array();
  std::string lines;
  for (const PartMatch& match : matches) {
    const DatabaseMesh& mesh = *meshes[match.mesh];
    const int faces = mesh.index.face_counts()[match.part];
    json["matches"].push_back(
        {{"file", mesh.file.string()}, {"part", match.part}, {"similarity", match.similarity}, {"faces", faces}});
    lines += fmt::format("\n  {:.4f}  {} part {} ({} faces)", match.similarity, mesh.file.string(), match.part, faces);
  }
  json["part"] = options.part;
  json["meshes"] = database.meshes.size();
  json["indexed"] = database.indexed;
  json["skipped"] = nlohmann::ordered_json::array();
  for (const auto& [file, reason] : database.skipped) {
    json["skipped"].push_back({{"file", file.string()}, {"reason", reason}});
  }
  json["input"] = options.query;
  const std::string written = run.report_files({{"glb", options.glb}});
  run.summary = fmt::format("{}: parts like part {} in {} meshes, {} of them indexed now{}{}{}", options.query,
                            options.part, database.meshes.size(), database.indexed,
                            database.skipped.empty() ? "" : fmt::format(", {} left out", database.skipped.size()),
                            lines, written);
}

// Moves a mesh to place `slot` of a row along x, its bounding sphere of radius 1 at y = z = 0; the part is coloured.
void add_to_row(Mesh mesh, const PartIndex& index, int part, int slot, std::vector<NamedMesh>& row) {
  const Sphere sphere = bounding_sphere(mesh);
  mesh.vertices.rowwise() -= sphere.centre;
  mesh.vertices /= sphere.radius;
  mesh.vertices.col(0).array() += 2.2 * slot;
  std::vector<int> is_part;
  for (const int label : index.labels) is_part.push_back(label == part ? 1 : 0);
  for (NamedMesh& member : part_meshes(mesh, is_part, 2)) {
    const bool found = member.name == "part_1";
    if (member.mesh.faces.rows() == 0) continue;
    member.colour = found ? Eigen::Vector3f(0.8f, 0.15f, 0.05f) : Eigen::Vector3f::Constant(0.5f);
    member.name = fmt::format("{}_{}", slot == 0 ? "query" : fmt::format("match_{}", slot), found ? "part" : "rest");
    row.push_back(std::move(member));
  }
}

void write_row(const Options& options, const Mesh& query, const PartIndex& query_index,
               const std::vector<const DatabaseMesh*>& meshes, const std::vector<PartMatch>& matches, Run& run) {
  std::vector<NamedMesh> row;
  add_to_row(query, query_index, options.part, 0, row);
  for (const PartMatch& match : matches) {
    const DatabaseMesh& mesh = *meshes[match.mesh];
    const int slot = static_cast<int>(&match - matches.data()) + 1;
    add_to_row(read_mesh(std::filesystem::path(options.database) / mesh.file), mesh.index, match.part, slot, row);
  }
  write_meshes(run.outputs.staged("--glb"), row);
}

void retrieve(const Options& options, Run& run) {
  run.outputs.add_input("QUERY", options.query);
  if (!options.glb.empty()) run.outputs.add("--glb", options.glb, {".glb"});
  const Mesh query = run.stage("read", [&] { return read_mesh(options.query); });
  const std::uint64_t content = mesh_content(options.query);
  const PartDatabase database =
      run.stage("index", [&] { return open_part_database(options.database, options.index, run.progress); });
  const DatabaseMesh* known = database.find(content);
  const PartIndex query_index = run.stage("query", [&] {
    return known ? known->index : naming_mesh(options.query, [&] { return index_parts(query, run.progress); });
  });
  const std::vector<const DatabaseMesh*> meshes = searched(database, content, options.others);
  const std::vector<PartMatch> matches = run.stage("search", [&] {
    std::vector<const PartIndex*> indices;
    indices.reserve(meshes.size());
    for (const DatabaseMesh* mesh : meshes) indices.push_back(&mesh->index);
    return similar_parts(query_index, options.part, indices, options.top);
  });
  run.stage("write", [&] {
    if (!options.glb.empty()) write_row(options, query, query_index, meshes, matches, run);
  });
  report(options, database, meshes, matches, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("QUERY", options->query, "The mesh with the part to look for")->required()->type_name("");
  add_count(command, "PART", options->part, 0,
            "Its number, from 0, as partwise segment QUERY --feature cvf-avg --labels writes it")
      ->required()
      ->type_name("");
  command.add_option("DATABASE_DIR", options->database, "A folder of meshes, searched with the folders below it")
      ->required()
      ->type_name("");
  add_count(command, "--top", options->top, 1, "How many parts to give [9]");
  command.add_flag("--others", options->others, "Leave out QUERY's own parts where the database holds it");
  command
      .add_option("--index", options->index,
                  "Keep what is computed of each mesh in this folder [DATABASE_DIR/.partwise]")
      ->type_name("DIR");
  add_file(command, "--glb", options->glb, "Write QUERY and its matches in a row, the parts coloured (.glb)");
  return [options](Run& run) { retrieve(*options, run); };
}

}  // namespace

const Verb retrieve_verb = {
    .name = "retrieve",
    .summary = "Parts like a given one in a folder of meshes",
    .details =
        "Finds the parts of the meshes in a folder that are most like part PART of QUERY, best first. Parts are "
        "compared\n"
        "with what they belong to (the part, its limb, and the whole): how much of the surface their places see, how\n"
        "thick they are, and how far out they lie. 1 is the same. Scale and position do not matter. A number that "
        "does\n"
        "not exist is answered by those that do.\n"
        "Each mesh is indexed once, which takes seconds; the index is kept beside the meshes and made anew when a "
        "mesh\n"
        "changes. A run that is stopped goes on where it was. Meshes that cannot be read are left out and named in "
        "--json.",
    .example =
        "  partwise segment horse.off --feature cvf-avg --labels horse.seg --glb horse_parts.glb\n"
        "  partwise retrieve horse.off 3 animals/ --top 5 --json -\n"
        "  partwise retrieve horse.off 3 animals/ --others --glb matches.glb",
    .add = add,
};

}  // namespace partwise::cli
