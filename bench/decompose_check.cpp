// Judges a decomposition by its files alone; shares no code with what made them. See bench/README.md for the fields.
//
//   decompose_check MESH LABELS HULLS.obj [--tolerance T] [--samples N] [--seed S]
//
// LABELS may be - for hulls that come without labels. Prints one JSON object on one line; lengths are shares of the
// bounding-sphere radius R. `failures` names each promise that is broken; exposure is one of them where a tolerance is
// given. Exits 0 when nothing is broken, 3 when something is, 1 when a file cannot be read, 2 for wrong usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/check/coverage.h"
#include "bench/check/exposure.h"
#include "bench/check/labelling.h"
#include "bench/tool.h"

namespace {

using namespace partwise::bench;
using Json = nlohmann::ordered_json;

constexpr double rounding = 1e-9;  // R: what counts as outside a hull, and as a dent in it

struct Options {
  std::string mesh, labels, hulls;
  CoverageSettings coverage;
  ExposureSettings exposure;
  std::uint64_t seed = 1;
};

struct Verdict {
  Json report;
  std::vector<std::string> failures;

  void expect(bool kept, const std::string& broken) {
    if (!kept) failures.push_back(broken);
  }
};

void judge_hulls(const std::vector<Hull>& hulls, double radius, Verdict& verdict) {
  bool convex = true, closed = true;
  double smallest = hulls.empty() ? 0 : std::numeric_limits<double>::infinity();
  std::size_t most_vertices = 0;
  for (const Hull& hull : hulls) {
    closed &= hull.written_closed();
    convex &= !hull.flat() && std::abs(hull.written_dent()) <= rounding * radius;
    smallest = std::min(smallest, hull.volume());
    most_vertices = std::max(most_vertices, hull.vertices().size());
  }
  verdict.report["hulls_closed"] = closed;
  verdict.report["hulls_convex"] = convex;
  verdict.report["min_hull_volume"] = smallest / std::pow(radius, 3);
  verdict.report["max_hull_vertices"] = most_vertices;
  verdict.expect(!hulls.empty(), "there are no hulls");
  verdict.expect(closed, "a hull is not closed");
  verdict.expect(smallest > 0, "a hull has no volume");
  verdict.expect(convex, "a hull is not convex");
}

void judge_parts(const Options& options, const Shape& shape, const std::vector<Hull>& hulls, double radius,
                 Verdict& verdict) {
  const Labelling labelling = judge_labels(shape, read_labels(options.labels), hulls, rounding * radius);
  verdict.report["parts"] = labelling.parts;
  verdict.report["labels_complete"] = labelling.complete;
  verdict.report["parts_connected"] = labelling.parts_connected;
  verdict.report["labels_match_hulls"] = labelling.hulls_match;
  verdict.report["hull_outside"] = labelling.hull_outside / radius;
  verdict.report["outside_all_hulls"] = labelling.outside_all / radius;
  verdict.expect(labelling.complete, "the labels are not one a face, 0 to parts - 1");
  verdict.expect(labelling.parts_connected, "a part is not connected");
  verdict.expect(labelling.parts == static_cast<int>(hulls.size()), "there is not one hull a part");
  verdict.expect(labelling.hulls_match, "another hull holds a part better than the one of its number");
  verdict.expect(labelling.hull_outside <= rounding * radius,
                 fmt::format("a vertex of part {} lies outside its hull", labelling.worst_part));
}

void judge_exposure(const Options& options, const Solid& solid, const std::vector<Hull>& hulls, Verdict& verdict) {
  const Exposures exposures = measure_exposure(solid, hulls, options.exposure);
  verdict.report["samples"] = exposures.samples;
  for (const auto& [name, exposure] :
       {std::pair{"exposure", exposures.exposed}, {"exposure_strict", exposures.strict}}) {
    verdict.report[name] = exposure.found;
    verdict.report[fmt::format("{}_sampled", name)] = exposure.sampled;
    verdict.report[fmt::format("{}_bound", name)] = exposure.bound;
    verdict.report[fmt::format("{}_hull", name)] = exposure.hull;
    verdict.report[fmt::format("{}_boxes", name)] = exposure.boxes;
  }
  if (!std::isfinite(options.exposure.limit)) return;
  verdict.report["tolerance"] = options.exposure.limit;
  verdict.report["exposure_certified"] = exposures.exposed.bound <= options.exposure.limit * (1 + rounding);
  verdict.expect(exposures.exposed.found <= options.exposure.limit * (1 + rounding),
                 fmt::format("hull {} sticks out by {:.6f} R", exposures.exposed.hull, exposures.exposed.found));
}

void judge_coverage(const Options& options, const Solid& solid, const Shape& shape, const std::vector<Hull>& hulls,
                    Verdict& verdict) {
  const Coverage coverage = measure_coverage(solid, shape, hulls, options.coverage);
  verdict.report["volume_mesh"] = solid.closed() ? Json(shape.signed_volume()) : Json();
  verdict.report["volume_solid"] = coverage.volume_solid;
  verdict.report["volume_union"] = coverage.volume_union;
  verdict.report["volume_union_error"] = coverage.volume_union_error;
  verdict.report["volume_ratio"] = coverage.ratio;
  verdict.report["volume_ratio_error"] = coverage.ratio_error;
  verdict.report["interior_uncovered"] = coverage.uncovered;
  verdict.report["interior_uncovered_error"] = coverage.uncovered_error;
}

Verdict judge(const Options& options) {
  const Shape shape = read_shape(options.mesh);
  const Solid solid(shape);
  std::vector<Hull> hulls;
  for (const Shape& written : read_objects(options.hulls)) hulls.emplace_back(written);
  Verdict verdict;
  verdict.report["mesh"] = options.mesh;
  verdict.report["faces"] = shape.faces.size();
  verdict.report["closed"] = solid.closed();
  verdict.report["radius"] = solid.radius();
  verdict.report["hulls"] = hulls.size();
  judge_hulls(hulls, solid.radius(), verdict);
  if (options.labels != "-") judge_parts(options, shape, hulls, solid.radius(), verdict);
  judge_exposure(options, solid, hulls, verdict);
  judge_coverage(options, solid, shape, hulls, verdict);
  verdict.report["failures"] = verdict.failures;
  return verdict;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Judges a decomposition by its files alone");
  app.add_option("mesh", options.mesh, "OFF or OBJ, triangles")->required();
  app.add_option("labels", options.labels, "a line a face, or - for none")->required();
  app.add_option("hulls", options.hulls, "OBJ, an object a part")->required();
  app.add_option("--tolerance", options.exposure.limit, "share of R that an exposed point may stick out");
  app.add_option("--samples", options.exposure.samples, "points drawn on and in the hulls, at least");
  app.add_option("--seed", options.seed, "of samples and lines");
  return run_tool("decompose_check", app, argc, argv, [&] {
    options.exposure.seed = options.coverage.seed = options.seed;
    const Verdict verdict = judge(options);
    std::cout << verdict.report.dump() << std::endl;
    return verdict.failures.empty() ? 0 : 3;
  });
}
