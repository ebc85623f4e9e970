#include "motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "beside.h"
#include "motion_pictures/path_scene.h"
#include "motion_pictures/roadmap_pictures.h"
#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/motion/axis_planner.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/path_simplify.h"
#include "partwise/motion/world.h"

namespace demo {
namespace {

using namespace partwise;
using Clock = std::chrono::steady_clock;

constexpr int houses = 354, sample_count = 6000;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int nearest_sample(const std::vector<AxisSample>& samples, const Eigen::Vector2d& place) {
  const auto distance = [&](const AxisSample& each) { return (each.q.head<2>() - place).squaredNorm(); };
  return static_cast<int>(std::ranges::min_element(samples, {}, distance) - samples.begin());
}

WayStory told(std::string_view name, const Scene& scene, const MotionPath& path) {
  return {name, path_length(scene.space(), path), path_clearance(scene, path).minimum};
}

void tell_town(MotionStory& story) {
  const City city = read_city(shared_file("data/city/kronstadt.geojson"), houses);
  const World world = city_world(city);
  const Scene& scene = *world.scene;
  const AxisSamplesSettings sampling{.count = sample_count};

  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Retractor> push = trained_push(scene, world.contacts);
  const AxisSamples found = axis_samples(scene, *push, sampling);
  story.methods.push_back({"max-margin fields", seconds_since(start), found.share_on_axis()});
  for (const bool exact : {false, true}) {
    const Clock::time_point begin = Clock::now();
    AxisSamplesSettings all = sampling;
    all.only_on_axis = false;
    const AxisSamples peer = axis_samples(scene, Maprm(scene, {.exact = exact}), all);
    story.methods.push_back(
        {exact ? "MAPRM, exact distances" : "MAPRM, rays", seconds_since(begin), peer.share_on_axis()});
  }

  const Roadmap roadmap = connected(scene, found.samples, *push);
  const auto& bounds = scene.space().bounds();
  const int from = nearest_sample(found.samples, bounds.min().head<2>());
  const int to = nearest_sample(found.samples, bounds.max().head<2>());
  const std::optional<MotionPath> wide = path_search(roadmap, found.samples, {from}, {to});
  const std::optional<MotionPath> narrow = path_search(roadmap, found.samples, {from}, {to}, {.clearance_exponent = 0});
  if (!wide || !narrow) throw InputError("kronstadt.geojson", "has no way through", "take another town");
  const MotionPath shortened = simplified(scene, *wide);
  story.ways = {told("with room, along the axis", scene, *wide), told("the same, shortened", scene, shortened),
                told("the shortest along the axis", scene, *narrow)};
  story.houses = scene.obstacles();
  story.samples = static_cast<int>(found.samples.size());
  story.town = make_drawing(
      roadmap_svg(city.footprints, found.samples, roadmap, {*wide, shortened}),
      fmt::format("{} footprints, {} samples; red: a way with room, orange: the same shortened", story.houses,
                  thousands(found.samples.size())),
      "A plan of a town with the lines that are as far from one house as from the next, and a way along them");
}

// From z up to y up: the ground lies flat.
Mesh laid_down(Mesh mesh) {
  mesh.vertices.col(1).swap(mesh.vertices.col(2));
  mesh.vertices.col(2) *= -1;
  return mesh;
}

void tell_window(MotionStory& story) {
  const PlanningProblem problem = read_planning_problem(shared_file("examples/window.json"));
  const ProblemScene made = problem_scene(problem);
  const Scene& scene = *made.scene;
  const std::unique_ptr<Retractor> push = trained_push(scene, made.contacts({}));
  AxisPlanner planner(scene, *push);
  planner.add_start(problem.queries.front().start);
  planner.add_goal(problem.queries.front().goal);
  const MotionPath path = simplified(scene, planner.solve({}));
  std::vector<NamedMesh> meshes = path_scene(problem, scene.space(), path);
  PreviewScene drawn;
  for (NamedMesh& each : meshes) {
    each.mesh = laid_down(std::move(each.mesh));
    drawn.meshes.push_back({each.mesh, {}, each.colour, 20});
  }
  story.window = make_turnable(
      drawn, meshes,
      {.slider = Slider::along, .label = "along the way", .azimuth = 15, .elevation = 50, .width = 1080, .height = 500},
      fmt::format("never nearer than {:.2f} to a wall; the stick is 0.4 wide, the window 1",
                  path_clearance(scene, path).minimum),
      "A stick, drawn at places along its way, turns and passes a window in a wall");
}

std::string methods_table(const std::vector<AxisStory>& methods) {
  std::vector<Row> rows;
  for (const AxisStory& each : methods) {
    rows.push_back({std::string(each.name), fmt::format("{:.2f} <small>s</small>", each.seconds),
                    fmt::format("{:.1f} %", 100 * each.on_axis)});
  }
  return table({"method", "time", "on the axis"}, rows);
}

std::string ways_table(const std::vector<WayStory>& ways) {
  std::vector<Row> rows;
  for (const WayStory& each : ways) {
    rows.push_back({std::string(each.name), fmt::format("{:.0f} <small>m</small>", each.length),
                    fmt::format("{:.2f} <small>m</small>", each.clearance)});
  }
  return table({"way", "length", "narrowest"}, rows);
}

}  // namespace

MotionStory tell_motion() {
  const Clock::time_point start = Clock::now();
  MotionStory story;
  tell_town(story);
  tell_window(story);
  story.seconds = seconds_since(start);
  return story;
}

std::string motion_chapter(const MotionStory& story) {
  std::string html = R"(<h2>Ways that keep their distance</h2>
<p class="lead">A robot that stays as far from one obstacle as from the next is safest. Classifiers with the largest margin, trained on points where
the robot would touch, tell two obstacles apart; where they cannot decide runs the middle between the two.</p>
<h3>Between the houses of a town</h3>
<div class="wide">
)" + figure(story.town) +
                     "</div>\n";
  html += fmt::format(
      "<p>{} samples, training included. A sample is on the axis where its two smallest distances differ by at most 2 "
      "%; those of max-margin fields are checked, others are thrown away.</p>\n",
      thousands(static_cast<std::uint64_t>(story.samples)));
  html += methods_table(story.methods);
  html +=
      "<h3>From corner to corner</h3>\n<p>The path with the smallest length over clearance, the same shortened so that "
      "it "
      "keeps nine tenths of its smallest clearance, and the shortest.</p>\n";
  html += ways_table(story.ways) + motion_beside();
  html += R"(<h3>Robots with a body</h3>
<p>Where robots turn, distances are those of their bodies, and every motion of a path is free all along, by certificate.</p>
)" + figure(story.window, "window");
  return html + fmt::format("<p class=\"note\">Computed and drawn in {:.0f} seconds.</p>\n", story.seconds);
}

std::string motion_credits() {
  return "<p>Footprints: Kronstadt, © <a href=\"https://www.openstreetmap.org/copyright\">OpenStreetMap "
         "contributors</a>, "
         "ODbL.</p>\n";
}

}  // namespace demo
