#include "repair.h"

#include <fmt/format.h>

#include <chrono>
#include <random>

#include "partwise/parts/solid/decompose.h"
#include "pictures.h"

namespace demo {
namespace {

using partwise::Mesh;
using Clock = std::chrono::steady_clock;

constexpr double removed = 0.45, tolerance = 0.1;

Mesh without_faces(const Mesh& mesh, double share) {
  std::mt19937 random(5);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (random() >= share * 4294967296.0) kept.push_back(f);
  }
  return {mesh.vertices, mesh.faces(kept, Eigen::all)};
}

}  // namespace

RepairStory tell_repair(const Mesh& horse, double azimuth) {
  RepairStory story;
  story.removed = removed;
  story.tolerance = tolerance;
  const Mesh broken = without_faces(horse, removed);
  const Clock::time_point start = Clock::now();
  const partwise::Repair repaired = partwise::repair(broken, {.tolerance = tolerance});
  story.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  story.reach = repaired.reach;
  story.faces = static_cast<int>(repaired.mesh.faces.rows());
  story.loss = repair_loss(repaired.mesh, horse);
  const auto add = [&](std::vector<partwise::PreviewMesh> meshes, std::string caption, std::string description) {
    partwise::PreviewScene scene;
    scene.meshes = std::move(meshes);
    story.pictures.push_back(make_picture(draw(scene, azimuth), std::move(caption), std::move(description)));
  };
  const partwise::Decomposition parts = partwise::decompose(broken, {.tolerance = tolerance});
  add({{horse, {}}}, "The intact mesh", "A horse");
  add({{broken, {}}}, fmt::format("Without {:.0f} % of its faces", 100 * removed),
      "The horse with nearly half of its faces missing");
  add(hull_meshes(parts, 0), fmt::format("{} hulls", parts.parts()), "The hulls of the parts of what is left");
  add({{repaired.mesh, {}}}, "Repaired", "The horse, closed again and a little fatter");
  return story;
}

std::string repair_chapter(const RepairStory& story) {
  return fmt::format(
             R"(<h2>Whole again</h2>
<p>A mesh without {:.0f} % of its faces still shows its parts. Their hulls are closed, and so is the surface around all of them: watertight, with
every face that was there inside (section 2.4.7.2 of the dissertation, Fig. 2.38). At tolerance {:.2f} R:</p>
)",
             100 * story.removed, story.tolerance) +
         figures(story.pictures, "row") + "<dl class=\"facts\">\n" +
         fact("from what was there, at most", fmt::format("{:.3f}", story.reach), "R") +
         fact("from the intact surface outwards", fmt::format("{:.3f}", story.loss.added), "R") +
         fact("inwards", fmt::format("{:.3f}", story.loss.lost), "R") +
         fact("volume", fmt::format("{:+.0f} %", 100 * (story.loss.volume_added - story.loss.volume_lost))) +
         fact("faces", thousands(static_cast<std::uint64_t>(story.faces))) +
         fact("repair", fmt::format("{:.1f}", story.seconds), "s") +
         "</dl>\n<p class=\"note\">The three distances are certified bounds.</p>\n";
}

}  // namespace demo
