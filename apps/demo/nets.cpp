#include "nets.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "partwise/parts/applications/net.h"
#include "partwise/parts/applications/net_sheets.h"
#include "partwise/parts/solid/decompose.h"
#include "pictures.h"

namespace demo {
namespace {

using Clock = std::chrono::steady_clock;

// All nets on one wide sheet, as large as they fit.
partwise::Sheets one_sheet(const std::vector<partwise::Unfolding>& unfoldings) {
  partwise::PageSettings sheet{.width = 280, .height = 160, .margin = 5};
  partwise::Sheets laid = lay_out(unfoldings, sheet);
  while (laid.pages > 1) {
    sheet.scale = 0.96 * laid.scale;
    laid = lay_out(unfoldings, sheet);
  }
  return laid;
}

}  // namespace

NetsStory tell_nets(const partwise::Mesh& mesh, double azimuth) {
  NetsStory story;
  const Clock::time_point start = Clock::now();
  const partwise::Decomposition parts = partwise::decompose(mesh, {.max_hull_vertices = 32});
  std::vector<partwise::Unfolding> unfoldings;
  for (const partwise::Mesh& hull : parts.hulls) {
    const partwise::Unfolding& unfolding = unfoldings.emplace_back(partwise::unfold(hull));
    story.nets += static_cast<int>(unfolding.nets.size());
    story.overlaps += unfolding.overlaps;
    story.glued += unfolding.glued;
    story.without_tab += unfolding.without_tab;
  }
  story.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  for (std::size_t i = 0; i < unfoldings.size(); ++i)
    story.refolding_error = std::max(story.refolding_error, refolding_error(unfoldings[i], parts.hulls[i]));
  story.parts = parts.parts();
  story.sheet = make_drawing(as_svg(one_sheet(unfoldings)), "Print, cut, fold, glue: sides with the same number meet",
                             "Nets of the parts of a dog, with folds, tabs and numbers");
  partwise::PreviewScene scene;
  scene.meshes.push_back({mesh, {}});
  const auto add = [&](std::string caption, std::string description) {
    story.bodies.push_back(make_picture(draw(scene, azimuth), std::move(caption), std::move(description)));
  };
  add("The mesh", "A dog");
  for (const double apart : {0.0, 0.35}) {
    scene.meshes = hull_meshes(parts, apart);
    for (partwise::PreviewMesh& body : scene.meshes) body.crease_degrees = 0;
    apart == 0 ? add("Its parts, of at most 32 corners", "The dog as convex bodies of few faces")
               : add("To be folded and glued", "The bodies drawn apart");
  }
  return story;
}

std::string nets_chapter(const NetsStory& story) {
  return R"(<h2>To be cut out and folded</h2>
<p>Nearly convex parts unfold well: each becomes a convex body of few faces, cut open along edges so that it lies flat in one piece.</p>
)" + figures(story.bodies, "row") +
         "<div class=\"wide strip\">\n" + figure(story.sheet) + "</div>\n<dl class=\"facts\">\n" +
         fact("parts", std::to_string(story.parts)) + fact("nets", std::to_string(story.nets)) +
         fact("faces that overlap", std::to_string(story.overlaps)) +
         fact("glued sides without a tab", fmt::format("{} of {}", story.without_tab, story.glued)) +
         fact("error when folded up again", fmt::format("{:.0e}", story.refolding_error), "of a part's radius") +
         fact("parts and nets", fmt::format("{:.2f}", story.seconds), "s") + "</dl>\n";
}

}  // namespace demo
