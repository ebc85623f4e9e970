#include "page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "html.h"
#include "page_surfaces.h"

namespace demo {
namespace {

struct Totals {
  int parts = 0, closed = 0;
  double ratio = 0, concavity = 0, seconds = 0;
};

Totals totals(const Story& story) {
  Totals sum;
  for (const ModelStory& model : story.models) {
    sum.parts += model.hull.parts;
    sum.concavity = std::max(sum.concavity, model.hull.concavity);
    sum.seconds += model.hull.seconds;
    if (!std::isfinite(model.hull.volume_ratio)) continue;
    ++sum.closed;
    sum.ratio += model.hull.volume_ratio;
  }
  sum.ratio /= std::max(1, sum.closed);
  return sum;
}

std::string opening(const Story& story) {
  const Totals sum = totals(story);
  const auto count = static_cast<double>(story.models.size());
  std::string html = R"(<header>
<p class="name">Partwise</p>
<h1>Shapes into nearly convex parts</h1>
<p class="lead">Physics engines, planners and robots want convex pieces; people model horses, chairs and coffee cups.
Partwise finds the few parts whose convex hulls stand in for the shape, within one tolerance that you choose,
and certifies that they do.</p>
)";
  for (const OtherPage& other : story.others)
    html += fmt::format("<p><a href=\"{}\">{}</a></p>\n", other.file, other.title);
  html += "</header>\n";
  html += "<div class=\"hero\">\n" + figure(story.pile.heap, "eager") + "</div>\n<dl class=\"facts large\">\n";
  html += fact("parts a model, mean", fmt::format("{:.1f}", sum.parts / count));
  html += fact("hull volume to solid volume, mean of the closed", fmt::format("{:.2f}", sum.ratio));
  html += fact("largest concavity of any part", fmt::format("{:.3f}", sum.concavity), "R");
  html += fact("to decompose a model, mean", fmt::format("{:.2f}", sum.seconds / count), "s");
  return html + "</dl>\n";
}

std::string figures_row(std::string_view measure, const Figures& figures) {
  const std::string ratio = std::isfinite(figures.volume_ratio) ? fmt::format("{:.2f}", figures.volume_ratio) : "open";
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{}</td><td>{:.3f} <small>R</small></td><td>{}</td>"
      "<td>{:.2f} <small>s</small></td></tr>\n",
      measure, figures.parts, figures.concavity, ratio, figures.seconds);
}

std::string model_article(const ModelStory& model) {
  std::string html =
      fmt::format("<article>\n<h3>{}</h3>\n<p class=\"meta\">{} faces, {}</p>\n", model.model.name,
                  thousands(static_cast<std::uint64_t>(model.faces)), model.watertight ? "closed" : "open");
  html += figures(model.pictures, "row");
  html +=
      "<table>\n<thead><tr><th scope=\"col\">measure</th><th scope=\"col\">parts</th><th scope=\"col\">concavity</th>"
      "<th scope=\"col\">volume ratio</th><th scope=\"col\">time</th></tr></thead>\n<tbody>\n";
  return html + figures_row("hull", model.hull) + figures_row("valley", model.valley) +
         "</tbody>\n</table>\n</article>\n";
}

std::string models_section(const Story& story) {
  std::string html = fmt::format(
      R"(<section>
<h2>One tolerance for all of them</h2>
<p>R is the radius of a model's bounding sphere, and the tolerance is {0:.2f} R. Every face belongs to one part, every part is
connected, and each hull encloses its part. What else is promised depends on the measure of concavity:</p>
<ul>
<li><b>hull</b>, which the pictures show: no point of any part's hull lies outside the solid by more than {0:.2f} R. An open mesh
has no inside: the distance is to its surface, so its hulls follow the shell, and there are more of them.</li>
<li><b>valley</b>, as published: between the ends of any edge of a part's hull, the shortest path on the part runs nowhere
deeper than {0:.2f} R below that edge, unless it keeps to the hull as the rim of a cup does.</li>
</ul>
<p>The volume ratio is the volume of the hulls' union over that of the solid; an open mesh has none.</p>
)",
      story.tolerance);
  for (const ModelStory& model : story.models) html += model_article(model);
  return html + "</section>\n";
}

std::string pile_section(const PileStory& pile) {
  std::string html = fmt::format(
      R"(<section>
<h2>Ready to simulate</h2>
<p>{} copies, {} convex hulls in all, fall onto a floor in Bullet. Each body is a compound of its model's hulls with their mass
and inertia. {:.0f} seconds of simulation took {:.1f} seconds of one core, and at the end no hull reached {}below the floor.</p>
)",
      pile.bodies, thousands(static_cast<std::uint64_t>(pile.hulls)), pile.simulated, pile.seconds,
      pile.deepest > 0 ? fmt::format("more than {:.3f} R ", std::ceil(1000 * pile.deepest) / 1000) : "");
  html += figures(pile.falling, "row");
  return html + "<div class=\"wide\">\n" + figure(pile.heap_hulls, "eager") + "</div>\n</section>\n";
}

std::string outlines_section(const OutlineStory& outlines) {
  std::string html = fmt::format(
      R"(<section>
<h2>And in the plane</h2>
<p>Outlines, silhouettes and floor plans are cut along diagonals between their own corners. No corner of a part is farther than {:.2f} R from the
bridge over its pocket, R the radius of the smallest circle around the shape. A skeleton runs from part to part through the cuts.</p>
)",
      outlines.tolerance);
  html += figures(outlines.clean, "row even") + figures(outlines.skeletons, "row even gap");
  html += fmt::format(
      R"(<h3>Noise changes little</h3>
<p>On the right, the edge of the same animal has been made ragged and its body speckled. The {} small holes count as noise: they stay holes, but no
cut is made for them. At 0.10 R the two decompositions agree to a Rand index of {:.2f}.</p>
)",
      outlines.noise_holes, outlines.rand_index);
  html += figures(outlines.noisy, "row even");
  return html + R"(<h3>A crowd</h3>
<p>Models from this page on one line, seen from the side: legs and bodies overlap and enclose gaps that matter, specks and ragged edges that do not.</p>
)" + "<div class=\"wide strip\">\n" +
         figure(outlines.herd, "eager") + "</div>\n</section>\n";
}

std::string use_section() {
  return R"(<section>
<h2>Use it</h2>
<div class="code">
<pre><code>partwise decompose horse.ply --tolerance 0.1 \
    --hulls hulls.obj --urdf horse.urdf</code></pre>
<pre><code>#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/solid/decompose.h"

const auto mesh = partwise::read_mesh("horse.ply");
const auto parts = partwise::decompose(mesh);
for (const auto&amp; hull : parts.hulls) add_to_world(hull);</code></pre>
</div>
</section>
)";
}

std::string closing(const Story& story) {
  std::string html =
      "<footer>\n<p>The models, all from the Sweet Home 3D furniture collections, stripped to their geometry: ";
  for (const ModelStory& model : story.models) {
    html += fmt::format("{}{} by {} ({})", &model == story.models.data() ? "" : ", ", model.model.name,
                        model.model.author, model.model.licence);
  }
  html += fmt::format(
      ". The outlines of bird, mammoth, neuron and the shape with three holes are examples of acd2d by Jyh-Ming Lien "
      "(MIT "
      "licence). Licences: <a href=\"https://creativecommons.org/publicdomain/zero/1.0/\">CC0 1.0</a>, "
      "<a href=\"https://creativecommons.org/licenses/by/3.0/\">CC BY 3.0</a>.</p>\n"
      "<p>Everything on this page was computed and drawn by one run of <code>partwise_demo</code>: {:.0f} seconds with "
      "{} "
      "threads.</p>\n</footer>\n",
      story.seconds, story.threads);
  return html;
}

}  // namespace

std::string make_page(const Story& story) {
  std::string html = page_head("Partwise: shapes into nearly convex parts");
  html += opening(story) + models_section(story) + pile_section(story.pile) + surfaces_section(story.surfaces) +
          outlines_section(story.outlines) + use_section();
  return html + "</main>\n" + closing(story) + "</body>\n</html>\n";
}

}  // namespace demo
