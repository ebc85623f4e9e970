// partwise outline: partwise::decompose_outline with files.

#include "partwise/parts/planar/outline.h"

#include <fmt/format.h>

#include <memory>

#include "options.h"
#include "partwise/parts/planar/outline_pictures.h"
#include "partwise/parts/planar/read_shape.h"
#include "partwise/parts/planar/skeleton.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string shape;
  PolygonReadSettings reading;
  OutlineSettings settings;
  bool strict = false;
  std::string parts, svg, skeleton;
};

void announce_outputs(const Options& options, Outputs& outputs) {
  outputs.add_input("SHAPE", options.shape);
  if (!options.parts.empty()) outputs.add("--parts", options.parts, {".geojson", ".json"});
  if (!options.svg.empty()) outputs.add("--svg", options.svg, {".svg"});
  if (!options.skeleton.empty()) outputs.add("--skeleton", options.skeleton, {".svg", ".geojson", ".json"});
}

void write_outputs(const Options& options, const Polygons& shape, const Outline& result, Outputs& outputs) {
  if (!options.parts.empty()) write_geojson(outputs.staged("--parts"), result.parts);
  const bool y_down = !options.shape.ends_with(".poly") && !options.shape.ends_with(".wkt") &&
                      !options.shape.ends_with(".geojson") && !options.shape.ends_with(".json");
  const PictureSettings picture{.y_down = y_down};
  if (!options.svg.empty()) write_outline_svg(outputs.staged("--svg"), result, picture);
  if (options.skeleton.empty()) return;
  const Skeleton skeleton = extract_skeleton(result);
  if (options.skeleton.ends_with(".svg")) {
    write_skeleton_svg(outputs.staged("--skeleton"), shape, skeleton, picture);
  } else {
    write_skeleton_geojson(outputs.staged("--skeleton"), skeleton);
  }
}

void report(const Options& options, const PolygonFile& file, const Outline& result, Run& run) {
  nlohmann::ordered_json& json = run.report;
  json["parts"] = result.parts.size();
  json["cuts"] = result.cuts.size();
  json["holes_kept"] = result.holes_kept();
  json["holes_noise"] = result.holes_noise();
  json["concavity"] = result.concavity;
  json["unresolved"] = result.unresolved;
  json["radius"] = result.radius;
  json["tolerance"] = result.tolerance;
  json["absolute"] = options.settings.absolute;
  json["area"] = area(file.polygons);
  json["input"] = options.shape;
  json["repaired"] = file.repaired.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(file.repaired);
  json["holes"] = nlohmann::ordered_json::array();
  for (const OutlineHole& hole : result.holes) {
    json["holes"].push_back({{"polygon", hole.polygon},
                             {"hole", hole.index},
                             {"concavity", hole.concavity},
                             {"class", hole.noise ? "noise" : "structure"}});
  }
  const std::string written =
      run.report_files({{"parts", options.parts}, {"svg", options.svg}, {"skeleton", options.skeleton}});
  const char* unit = options.settings.absolute ? "" : " R";
  const std::string holes = result.holes.empty()
                                ? ""
                                : fmt::format(", {} hole{} kept, {} noise", result.holes_kept(),
                                              result.holes_kept() == 1 ? "" : "s", result.holes_noise());
  const std::string repaired = file.repaired.empty() ? "" : fmt::format("\nrepaired: {}", file.repaired);
  run.summary = fmt::format("{}: {} part{}, concavity {:.4g}{} (tolerance {:.4g}{}){}{}{}", options.shape,
                            result.parts.size(), result.parts.size() == 1 ? "" : "s", result.concavity, unit,
                            result.tolerance, unit, holes, repaired, written);
}

void outline_files(const Options& options, Run& run) {
  announce_outputs(options, run.outputs);
  PolygonReadSettings reading = options.reading;
  reading.repair = !options.strict;
  const PolygonFile file = run.stage("read", [&] { return read_shape(options.shape, reading); });
  const Outline result = decompose_outline(file.polygons, options.settings, run.progress);
  for (const auto& [stage, seconds] : result.seconds) run.seconds[stage] = seconds;
  run.stage("write", [&] { write_outputs(options, file.polygons, result, run.outputs); });
  report(options, file, result, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("SHAPE", options->shape, "The shape: .poly, .svg, .geojson, .json, .wkt, or a mask .png")
      ->required()
      ->type_name("");
  add_positive(
      command, "--tolerance", options->settings.tolerance,
      "Largest concavity of a part, as a share of R, the radius of the shape's smallest enclosing circle; 0.1 is "
      "coarse, 0.01 fine")
      ->required();
  command.add_flag("--absolute", options->settings.absolute, "T is in the units of the shape");
  command.add_flag("--lenient", options->reading.lenient, "Read numbers of .poly that lost the blank between them");
  command.add_flag("--strict", options->strict, "Refuse shapes that are not valid instead of repairing them");
  add_positive(command, "--flattening", options->reading.flattening,
               "How far chords may leave the curves of an .svg, in its units [1/2000 of the longer side of its box]");
  add_file(command, "--parts", options->parts, "Write the parts as polygons (.geojson)");
  add_file(command, "--svg", options->svg, "Draw the parts");
  add_file(command, "--skeleton", options->skeleton, "Write the skeleton: a drawing (.svg) or a graph (.geojson)");
  return [options](Run& run) { outline_files(*options, run); };
}

}  // namespace

const Verb outline_verb = {
    "outline", "Cut a shape in the plane into nearly convex parts",
    "Parts tile the shape: cuts run between its own corners. No corner of a part is farther than T from the part's "
    "convex "
    "hull. Holes within T are noise and steer no cut. Masks: pixels above half are inside, coordinates in pixels, y "
    "down.",
    "  partwise outline bird.poly --tolerance 0.05 --parts parts.geojson --svg parts.svg --skeleton skeleton.svg", add};

}  // namespace partwise::cli
