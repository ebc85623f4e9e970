#include "cages.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "partwise/geometry/topology.h"
#include "partwise/parts/applications/cage.h"
#include "partwise/parts/applications/cage_deformer.h"
#include "pictures.h"

namespace demo {
namespace {

using partwise::Mesh;
using partwise::Point;
using partwise::PreviewScene;
using partwise::Vertices;
using Clock = std::chrono::steady_clock;

const Eigen::Vector3f horse_colour(0.46f, 0.27f, 0.13f), cage_colour(0.05f, 0.12f, 0.3f);

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// From 0 below `low` to 1 above `high`, without corners.
double rise(double value, double low, double high) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Ways to move the cage's vertices. A place is told in shares of the model's box: x across, y up, z from tail to head.
struct Move {
  std::string_view name;
  std::function<Point(const Point& share, const Point& size)> by;
};

const std::array<Move, 4>& moves() {
  static const std::array<Move, 4> all{{
      {"A neck like a giraffe's",
       [](const Point& share, const Point& size) -> Point {
         return Point(0, 0.32, 0.08) * size.y() * rise(share.y(), 0.62, 0.85) * rise(share.z(), 0.5, 0.7);
       }},
      {"Longer in the body",
       [](const Point& share, const Point& size) -> Point {
         return Point(0, 0, 0.5) * size.z() * (rise(share.z(), 0.3, 0.6) - 0.5);
       }},
      {"Looking back",
       [](const Point& share, const Point& size) -> Point {
         const double turn = 1.4 * rise(share.z(), 0.62, 0.9) * rise(share.y(), 0.45, 0.7);
         const Point arm = (share - Point(0.5, 0, 0.62)).cwiseProduct(size);
         return Point(std::cos(turn) * arm.x() + std::sin(turn) * arm.z() - arm.x(), 0,
                      -std::sin(turn) * arm.x() + std::cos(turn) * arm.z() - arm.z());
       }},
      {"On short legs",
       [](const Point& share, const Point& size) -> Point {
         return Point(0, -0.26, 0) * size.y() * rise(share.y(), 0.05, 0.5);
       }},
  }};
  return all;
}

Vertices moved(const Vertices& cage, const Eigen::AlignedBox3d& box, const Move& move) {
  Vertices result = cage;
  const Point low = box.min().transpose(), size = box.sizes().transpose();
  for (Eigen::Index v = 0; v < cage.rows(); ++v) {
    const Point share = (cage.row(v) - low).cwiseQuotient(size);
    result.row(v) += move.by(share, size);
  }
  return result;
}

PreviewScene in_cage(const Mesh& mesh, const Mesh& cage) {
  PreviewScene scene;
  scene.meshes.push_back({mesh, {}, horse_colour});
  const double thickness = 0.0035 * bounding_sphere(cage).radius;
  for_each_edge(sorted_half_edges(cage), [&](std::span<const partwise::HalfEdge> edge) {
    const std::vector<int> ends{edge[0].low, edge[0].high};
    scene.curves.push_back({cage.vertices(ends, Eigen::all), thickness, cage_colour});
  });
  return scene;
}

}  // namespace

CagesStory tell_cages(const Mesh& horse, double azimuth) {
  CagesStory story;
  Clock::time_point start = Clock::now();
  const partwise::Cage cage = partwise::make_cage(horse);
  story.cage_seconds = seconds_since(start);
  start = Clock::now();
  const partwise::CageDeformer deformer(horse.vertices, cage.mesh);
  story.weigh_seconds = seconds_since(start);
  story.faces = static_cast<int>(horse.faces.rows());
  story.cage_faces = static_cast<int>(cage.mesh.faces.rows());
  story.identity_error =
      (deformer.deformed(cage.mesh.vertices) - horse.vertices).rowwise().norm().maxCoeff() / cage.radius;
  Eigen::AlignedBox3d box;
  for (const auto& p : horse.vertices.rowwise()) box.extend(p.transpose());
  for (const Move& move : moves()) {
    const Mesh cage_after{moved(cage.mesh.vertices, box, move), cage.mesh.faces};
    start = Clock::now();
    const Mesh after{deformer.deformed(cage_after.vertices), horse.faces};
    story.move_seconds += seconds_since(start) / static_cast<double>(moves().size());
    story.deformed.push_back(make_picture(draw(in_cage(after, cage_after), azimuth), std::string(move.name),
                                          fmt::format("The horse, deformed: {}", move.name)));
    if (&move != moves().data()) continue;
    const std::array<partwise::NamedMesh, 4> meshes{{{"horse from", horse, horse_colour},
                                                     {"horse to", after, horse_colour},
                                                     {"cage from", cage.mesh, cage_colour},
                                                     {"cage to", cage_after, cage_colour}}};
    story.horse = make_turnable(in_cage(horse, cage.mesh), meshes,
                                {.slider = Slider::between, .label = "longer neck", .azimuth = azimuth, .height = 600},
                                fmt::format("A horse of {} faces in a cage of {}",
                                            thousands(static_cast<std::uint64_t>(story.faces)), story.cage_faces),
                                "A horse inside the edges of its cage");
  }
  return story;
}

std::string cages_chapter(const CagesStory& story) {
  return R"(<h2>A cage to deform it by</h2>
<p>The hulls of the parts, grown a little and joined, make a coarse closed surface around the mesh: a cage, with a leg where the mesh has one. Whoever
moves its few vertices moves the mesh, and small details keep their shape (section 2.4.7.1 of the dissertation; Green coordinates).</p>
<div class="pair">
)" + figure(story.horse, "cage-model") +
         figures(story.deformed, "row two") + "</div>\n<dl class=\"facts\">\n" +
         fact("cage, parts included", fmt::format("{:.2f}", story.cage_seconds), "s") +
         fact("coordinates, once", fmt::format("{:.2f}", story.weigh_seconds), "s") +
         fact("a deformation", fmt::format("{:.1f}", 1000 * story.move_seconds), "ms") +
         fact("error where the cage stays", fmt::format("{:.0e}", story.identity_error), "R") + "</dl>\n";
}

}  // namespace demo
