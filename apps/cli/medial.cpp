// partwise medial: partwise::medial_samples with files.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

#include "named_places.h"
#include "options.h"
#include "partwise/appearance/colouring.h"
#include "partwise/base/atomic_file.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/medial_samples.h"
#include "picture.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180;

struct Options {
  std::string mesh, points, png;
  double least_angle = 60;  // degrees
  MedialSettings settings;
};

std::string as_ply(const MedialSamples& samples) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment centres of balls inside the surface, and their radii\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nproperty double radius\nend_header\n",
      samples.radii.size());
  for (std::size_t i = 0; i < samples.radii.size(); ++i) {
    const auto point = samples.points.row(static_cast<Eigen::Index>(i));
    text += fmt::format("{} {} {} {}\n", point[0], point[1], point[2], samples.radii[i]);
  }
  return text;
}

void draw(const std::filesystem::path& path, const Mesh& mesh, const MedialSamples& samples) {
  const double bead = 0.012 * bounding_sphere(mesh).radius;
  write_picture(path, coloured_by_value(samples.points, samples.radii, bead));
}

void medial_samples_of_file(const Options& options, Run& run) {
  run.outputs.add_input("MESH", options.mesh);
  if (!options.points.empty()) run.outputs.add("--points", options.points, {".ply"});
  if (!options.png.empty()) run.outputs.add("--png", options.png, {".png"});
  MedialSettings settings = options.settings;
  settings.least_angle = options.least_angle * kPerDegree;
  const Mesh mesh = run.stage("read", [&] { return read_mesh(options.mesh); });
  const MedialSamples samples = run.stage("samples", [&] {
    return naming_mesh(options.mesh, [&] { return medial_samples(mesh, settings, run.progress); });
  });
  run.stage("write", [&] {
    if (!options.points.empty()) write_file(run.outputs.staged("--points"), as_ply(samples));
    if (!options.png.empty()) draw(run.outputs.staged("--png"), mesh, samples);
  });
  run.report["samples"] = samples.radii.size();
  run.report["spacing"] = settings.spacing;
  run.report["least_angle"] = options.least_angle;
  run.report["input"] = options.mesh;
  const std::string written = run.report_files({{"points", options.points}, {"png", options.png}});
  run.summary = fmt::format("{}: {} points of the medial axis{}", options.mesh, samples.radii.size(), written);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  add_mesh(command, options->mesh);
  add_file(command, "--points", options->points, "Write the points and the distance of each to the surface (.ply)");
  add_file(command, "--png", options->png,
           "Draw the points as beads, coloured from dark blue, nearest to the surface, to yellow, deepest (.png)");
  add_positive(command, "--spacing", options->settings.spacing,
               "Halve edges that are longer than this share of the bounding-sphere radius first [0.1]");
  add_positive(command, "--least-angle", options->least_angle,
               "Degrees between the two nearest points of the surface, seen from the sample: less lets smaller bumps "
               "have samples of their own [60]");
  return [options](Run& run) { medial_samples_of_file(*options, run); };
}

}  // namespace

const Verb medial_verb = {
    .name = "medial",
    .summary = "Points of the medial axis of a mesh",
    .details =
        "For each vertex the largest ball inside that touches the surface there and in a second point which the "
        "vertex\n"
        "sees continuously; its centre is as far from both.",
    .example = "  partwise medial hand.off --points hand_axis.ply --png hand_axis.png",
    .add = add,
};

}  // namespace partwise::cli
