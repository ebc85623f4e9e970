#include "page.h"

#include <fmt/format.h>

#include "turnable.h"

namespace demo {
namespace {

std::string opening(const Page& page) {
  std::string html = R"(<header>
<p class="name">Partwise</p>
<h1>Shapes into parts, and what parts are good for</h1>
<p class="lead">Physics engines, planners and robots want convex pieces; people model horses, chairs and coffee cups.
Partwise finds the few parts whose convex hulls stand in for the shape, within one tolerance that you choose,
and certifies that they do. Parts then wear materials, teach networks and keep robots out of harm&rsquo;s way.</p>
</header>
<nav aria-label="Contents">
)";
  for (const Chapter& chapter : page.chapters)
    html += fmt::format("<a href=\"#{}\">{}</a>\n", chapter.id, chapter.name);
  html += "</nav>\n<div class=\"hero\">\n" + figure(page.hero) + "</div>\n<dl class=\"facts large\">\n" + page.facts +
          "</dl>\n<div class=\"story\">\n";
  for (const Station& station : page.story) {
    Picture picture = station.picture;
    picture.caption = station.name;
    html += fmt::format("<a href=\"#{}\">{}</a>\n", station.chapter, figure(picture));
  }
  return html + "</div>\n";
}

std::string use_chapter() {
  return R"(<h2>Use it</h2>
<div class="code">
<pre><code>partwise decompose horse.ply --tolerance 0.1 \
    --hulls hulls.obj --urdf horse.urdf</code></pre>
<pre><code>#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/solid/decompose.h"

const auto mesh = partwise::read_mesh("horse.ply");
const auto parts = partwise::decompose(mesh);
for (const auto&amp; hull : parts.hulls) add_to_world(hull);</code></pre>
</div>
)";
}

std::string closing(const Page& page) {
  return fmt::format(
      "<footer>\n{}<p>Models are turned by <a href=\"https://threejs.org\">three.js</a> (MIT licence).</p>\n"
      "<p>Everything on this page but the figures said to be recorded earlier was computed, measured and drawn by one "
      "run of "
      "<code>partwise_demo</code>: {:.0f} seconds with {} threads.</p>\n</footer>\n",
      page.credits, page.seconds, page.threads);
}

}  // namespace

std::string make_page(const Page& page) {
  Page whole = page;
  whole.chapters.push_back({"use", "Use it", use_chapter()});
  std::string html = page_head("Partwise: shapes into parts") + opening(whole);
  for (const Chapter& chapter : whole.chapters)
    html += fmt::format("<section id=\"{}\">\n{}</section>\n", chapter.id, chapter.html);
  return html + "</main>\n" + closing(page) + viewer_scripts() + "</body>\n</html>\n";
}

}  // namespace demo
