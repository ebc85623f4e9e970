#include "repairs.h"

#include <fmt/format.h>

#include <chrono>
#include <random>

#include "pictures.h"

namespace demo {
namespace {

using partwise::Mesh;
using Clock = std::chrono::steady_clock;

constexpr double removed = 0.45;

Mesh without_faces(const Mesh& mesh, double share) {
  std::mt19937 random(5);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (random() >= share * 4294967296.0) kept.push_back(f);
  }
  return {mesh.vertices, mesh.faces(kept, Eigen::all)};
}

Picture drawn(const Mesh& mesh, double azimuth, std::string caption, std::string description) {
  partwise::PreviewScene scene;
  scene.meshes.push_back({mesh, {}});
  return make_picture(draw(scene, azimuth), std::move(caption), std::move(description));
}

}  // namespace

RepairsStory tell_repairs(const Mesh& horse, double azimuth) {
  RepairsStory story;
  story.removed = removed;
  const Mesh broken = without_faces(horse, removed);
  story.pictures = {drawn(horse, azimuth, "The intact mesh", "A horse"),
                    drawn(broken, azimuth, fmt::format("Without {:.0f} % of its faces", 100 * removed),
                          "The horse with nearly half of its faces missing")};
  for (const double tolerance : {0.1, 0.05}) {
    const Clock::time_point start = Clock::now();
    const partwise::Repair repaired = partwise::repair(broken, {.tolerance = tolerance});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    story.repairs.push_back({tolerance, repaired.parts, repaired.reach, seconds, repair_loss(repaired.mesh, horse)});
    story.pictures.push_back(drawn(repaired.mesh, azimuth, fmt::format("Repaired, tolerance {:.2f}", tolerance),
                                   fmt::format("The horse, closed again at tolerance {:.2f}", tolerance)));
  }
  return story;
}

std::string repairs_chapter(const RepairsStory& story) {
  std::string html = fmt::format(
      R"(<h2>Whole again</h2>
<p>A mesh without {:.0f} % of its faces still shows its parts. Their hulls are closed, and so is the surface around all of them: watertight, with
every face that was there inside (section 2.4.7.2, Fig. 2.38).</p>
)",
      100 * story.removed);
  html += figures(story.pictures, "row");
  std::vector<Row> rows;
  for (const RepairStory& each : story.repairs) {
    const auto in_r = [](double length) { return fmt::format("{:.3f} <small>R</small>", length); };
    rows.push_back({fmt::format("{:.2f} <small>R</small>", each.tolerance), std::to_string(each.parts), in_r(each.loss.added),
                    in_r(each.loss.lost), fmt::format("{:+.0f} %", 100 * (each.loss.volume_added - each.loss.volume_lost)),
                    fmt::format("{:.1f} <small>s</small>", each.seconds)});
  }
  return html + table({"tolerance", "parts", "added", "lost", "volume", "time"}, rows) +
         "<p class=\"note\">Added and lost: how far the repaired and the intact surface lie outside of each other at most, certified.</p>\n";
}

}  // namespace demo
