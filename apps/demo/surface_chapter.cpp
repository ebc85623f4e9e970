#include "surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "beside.h"
#include "partwise/appearance/palette.h"
#include "partwise/imaging/image.h"

namespace demo {
namespace {

// The colours of values from the least to the most, as a bar.
std::string scale() {
  constexpr int stops = 9;
  std::string colours;
  for (int i = 0; i < stops; ++i) {
    const Eigen::Vector3f linear = partwise::value_colour(static_cast<float>(i) / (stops - 1));
    colours += ", #";
    for (const float channel : linear)
      colours += fmt::format("{:02x}", std::lround(255 * std::clamp(partwise::srgb_from_linear(channel), 0.0f, 1.0f)));
  }
  return fmt::format(
      "<p class=\"scale\">least <span role=\"img\" aria-label=\"dark blue over teal to yellow\" "
      "style=\"background: linear-gradient(to right{})\"></span> most</p>\n",
      colours);
}

std::string features_table(const SurfaceStory& model) {
  std::vector<Row> rows;
  for (const FeatureStory& feature : model.features) {
    rows.push_back({feature.name, std::to_string(feature.part_count),
                    feature.tests > 0 ? thousands(feature.tests) : "&ndash;",
                    fmt::format("{:.2f} <small>s</small>", feature.seconds)});
  }
  return table({"feature", "parts", "tests", "time"}, rows);
}

std::string surface_article(const SurfaceStory& model) {
  std::vector<Picture> maps, parts;
  for (const FeatureStory& feature : model.features) {
    maps.push_back(feature.map);
    parts.push_back(feature.parts);
  }
  return fmt::format("<article class=\"surface\">\n<h3>{}</h3>\n<p class=\"meta\">{} vertices</p>\n", model.name,
                     thousands(static_cast<std::uint64_t>(model.vertices))) +
         figures(maps, "row") + figures(parts, "row") + features_table(model) + "</article>\n";
}

}  // namespace

std::string surfaces_chapter(const SurfacesStory& story) {
  std::string html = R"(<h2>Parts as people see them</h2>
<p>People cut a horse into head, legs and body, convex or not. A number on every point of the surface, large on large parts and small on small
ones, says where. Four such numbers, and below each the parts that come from it, with the same two settings for all:</p>
<ul>
<li><b>SDF</b>, shape diameter: how thick the solid is below the point. The fastest, but a handle as thick as the wall that it joins
looks the same.</li>
<li><b>CVF</b>, continuous visibility: the area that a vertex sees through the solid, along paths that it sees all of.</li>
<li><b>CVF averaged</b> with the value on the other side of the wall, so that both sides are alike. Of the four the closest to people.</li>
<li><b>CVF weak</b>: paths may be hidden for a tenth of R, so that values change more slowly.</li>
</ul>
<p>A test is one ray that asks whether two vertices see each other. The colours of a picture run from its least value to its most:</p>
)";
  html += scale();
  for (const SurfaceStory& model : story.models) html += surface_article(model);
  html += R"(<h3>What lies in the middle</h3>
<p>The same visibility finds the medial axis: for each vertex the ball inside that touches the surface there and once more. The beads are the
centres of the balls, coloured by radius on the same scale; the nearer half of each model is cut away.</p>
)";
  return html + figures(story.medial, "row") + segments_beside();
}

}  // namespace demo
