// Judges points of the medial axis by the mesh and the file alone; shares no code with what made them.
//
//   medial_check MESH.off POINTS.ply [--least-angle DEGREES] [--samples N] [--seed S]
//
// The judge's own axis is that of check/medial_axis.h, filtered by the same angle as the points. Prints one JSON
// object, lengths as shares of the bounding-sphere radius R: distances of the points to the judge's axis (`to_axis`),
// of that axis to the points (`from_axis`: what the points leave out), of a second axis from another sample to the
// first (`repeat`: how exact the judge is), and by how much the radii differ from the distance to the surface
// (`radius_error`); each as mean, 95 % and largest. `inside`: the share of the points in the solid, null for an open
// mesh. Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "bench/check/medial_axis.h"
#include "bench/tool.h"

namespace {

using namespace partwise::bench;
using nlohmann::ordered_json;

struct Balls {
  std::vector<Point> centres;
  std::vector<double> radii;
};

Balls read_balls(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  while (std::getline(in, line) && line != "end_header") {
  }
  if (!in) throw std::runtime_error(path + ": no end of a PLY header");
  Balls balls;
  for (double x, y, z, radius; in >> x >> y >> z >> radius;) {
    balls.centres.emplace_back(x, y, z);
    balls.radii.push_back(radius);
  }
  if (balls.radii.empty() || !in.eof()) throw std::runtime_error(path + ": expected lines of x y z radius");
  return balls;
}

// Of ascending lengths.
ordered_json summary(const std::vector<double>& lengths, double radius) {
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  return {
      {"mean", mean / radius}, {"p95", lengths[lengths.size() * 95 / 100] / radius}, {"max", lengths.back() / radius}};
}

std::vector<double> radius_errors(const Balls& balls, const Solid& solid) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < balls.radii.size(); ++i)
    errors.push_back(std::abs(solid.distance(balls.centres[i]) - balls.radii[i]));
  std::sort(errors.begin(), errors.end());
  return errors;
}

ordered_json share_inside(const Balls& balls, const Solid& solid) {
  if (!solid.closed()) return nullptr;
  const auto count = std::count_if(balls.centres.begin(), balls.centres.end(),
                                   [&](const Point& centre) { return solid.inside(centre); });
  return static_cast<double>(count) / static_cast<double>(balls.centres.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::string mesh, points;
  MedialAxisSettings settings;
  CLI::App app("Judges points of the medial axis");
  app.add_option("mesh", mesh, "OFF file of triangles")->required();
  app.add_option("points", points, "PLY file of x, y, z, radius")->required();
  app.add_option("--least-angle", settings.least_angle, "degrees")->check(CLI::Range(0.0, 180.0));
  app.add_option("--samples", settings.samples, "of the surface")->check(CLI::Range(100, 10'000'000));
  app.add_option("--seed", settings.seed, "of the samples");
  return run_tool("medial_check", app, argc, argv, [&] {
    const Shape shape = read_shape(mesh);
    const Solid solid(shape);
    const Balls balls = read_balls(points);
    const std::vector<Point> axis = medial_axis(shape, solid, settings);
    ++settings.seed;
    const std::vector<Point> again = medial_axis(shape, solid, settings);
    if (axis.empty() || again.empty()) throw std::runtime_error(mesh + ": no medial axis at this angle");
    const double radius = solid.radius();
    std::cout << ordered_json{{"mesh", mesh},
                              {"points", balls.radii.size()},
                              {"axis_points", axis.size()},
                              {"to_axis", summary(distances_to_nearest(balls.centres, axis), radius)},
                              {"from_axis", summary(distances_to_nearest(axis, balls.centres), radius)},
                              {"repeat", summary(distances_to_nearest(again, axis), radius)},
                              {"radius_error", summary(radius_errors(balls, solid), radius)},
                              {"inside", share_inside(balls, solid)}}
                     .dump()
              << '\n';
    return 0;
  });
}
