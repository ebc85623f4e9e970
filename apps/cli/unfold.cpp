// partwise unfold: partwise::unfold for the hulls of a mesh's parts, with files.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "named_places.h"
#include "options.h"
#include "part_meshes.h"
#include "partwise/base/atomic_file.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/applications/net.h"
#include "partwise/parts/applications/net_sheets.h"
#include "partwise/parts/solid/decompose.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string mesh, svg, pdf, hulls;
  DecompositionSettings parts{.max_hull_vertices = 32};
  PageSettings pages;
  UnfoldSettings nets;
};

void unfold_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  run.outputs.add("--output", options.svg, {".svg"});
  if (!options.pdf.empty()) run.outputs.add("--pdf", options.pdf, {".pdf"});
  if (!options.hulls.empty()) run.outputs.add("--hulls", options.hulls, {".obj", ".glb"});
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const Decomposition parts = naming_mesh(options.mesh, [&] { return decompose(mesh, options.parts, run.progress); });
  for (const auto& [stage, seconds] : parts.seconds) run.seconds[stage] = seconds;
  std::vector<Unfolding> unfoldings;
  std::size_t nets = 0;
  int overlaps = 0, glued = 0, without_tab = 0;
  double refolding = 0;
  run.stage("unfold", [&] {
    for (const Mesh& hull : parts.hulls) {
      run.progress("unfold", static_cast<double>(unfoldings.size()) / parts.parts());
      const Unfolding& unfolding = unfoldings.emplace_back(unfold(hull, options.nets));
      nets += unfolding.nets.size();
      overlaps += unfolding.overlaps;
      glued += unfolding.glued;
      without_tab += unfolding.without_tab;
      refolding = std::max(refolding, refolding_error(unfolding, hull));
    }
  });
  const Sheets sheets = run.stage("pages", [&] { return lay_out(unfoldings, options.pages); });
  run.stage("write", [&] {
    write_file(run.outputs.staged("--output"), as_svg(sheets));
    if (!options.pdf.empty()) write_file(run.outputs.staged("--pdf"), as_pdf(sheets));
    if (!options.hulls.empty()) write_meshes(run.outputs.staged("--hulls"), hull_meshes(parts.hulls));
  });
  run.report["parts"] = parts.parts();
  run.report["nets"] = nets;
  run.report["overlaps"] = overlaps;
  run.report["refolding_error"] = refolding;
  run.report["glued"] = glued;
  run.report["without_tab"] = without_tab;
  run.report["pages"] = sheets.pages;
  run.report["scale"] = sheets.scale;
  run.report["tolerance"] = options.parts.tolerance;
  run.report["concavity"] = parts.concavity;
  run.report["input"] = options.mesh;
  const std::string written =
      run.report_files({{"output", options.svg}, {"pdf", options.pdf}, {"hulls", options.hulls}});
  run.summary = fmt::format("{}: {} part{} as {} net{} on {} page{}, {:.4g} mm a unit{}", options.mesh, parts.parts(),
                            parts.parts() == 1 ? "" : "s", nets, nets == 1 ? "" : "s", sheets.pages,
                            sheets.pages == 1 ? "" : "s", sheets.scale, written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  add_mesh(command, options->mesh);
  add_file(command, "-o,--output", options->svg, "Write the nets, A4 pages one below the other (.svg)")->required();
  add_file(command, "--pdf", options->pdf, "Write the nets, A4 pages to print (.pdf)");
  add_file(command, "--hulls", options->hulls,
           "Write the parts that the nets fold into, one object each (.obj or .glb)");
  add_positive(command, "--tolerance", options->parts.tolerance,
               "Largest concavity of a part, a share of R, the radius of the mesh's bounding sphere [0.1]");
  add_count(command, "--max-hull-vertices", options->parts.max_hull_vertices, 4,
            "At most N vertices a part, so that it can be folded by hand [32]");
  add_positive(command, "--scale", options->pages.scale,
               "Millimetres a model unit [as large as the largest net fits a page]");
  return [options](Run& run) { unfold_file(*options, run); };
}

}  // namespace

const Verb unfold_verb = {
    .name = "unfold",
    .summary = "The parts of a mesh as nets to print, fold and glue",
    .details =
        "Each nearly convex part becomes a convex body of few faces and is cut open along edges, so that it lies flat "
        "and\n"
        "no two faces overlap. Sides with the same number are glued together, by the grey tabs.",
    .example = "  partwise unfold horse.ply -o horse.svg --pdf horse.pdf",
    .add = add,
};

}  // namespace partwise::cli
