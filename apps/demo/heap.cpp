#include "heap.h"

#include <fmt/format.h>

#include <cmath>

namespace demo {

HeapStory tell_heap(const PileSettings& settings, const Pile& pile) {
  HeapStory story{settings.bodies, pile.hulls, settings.seconds, pile.seconds, pile.deepest, {}, {}, {}};
  const PilePictures drawn = draw_pile(pile, settings);
  for (std::size_t i = 0; i < drawn.falling.size(); ++i) {
    const std::string when = fmt::format("after {:.1f} s", settings.frames[i]);
    story.falling.push_back(make_picture(drawn.falling[i], when, "Bodies falling, " + when));
  }
  story.heap = make_picture(
      drawn.heap,
      fmt::format("{} decomposed models at rest, simulated as {} convex hulls", settings.bodies, pile.hulls),
      "A heap of horses, chairs, cups and other models");
  story.heap_hulls = make_picture(drawn.heap_hulls, "The same heap as the physics engine sees it",
                                  "The same heap drawn as coloured convex hulls");
  return story;
}

std::string heap_chapter(const HeapStory& story) {
  std::string html = fmt::format(
      R"(<h2>Ready to simulate</h2>
<p>{} copies, {} convex hulls in all, fall onto a floor in Bullet. Each body is a compound of its model's hulls with their mass
and inertia. {:.0f} seconds of simulation took {:.1f} seconds of one core, and at the end no hull reached {}below the floor.</p>
)",
      story.bodies, thousands(static_cast<std::uint64_t>(story.hulls)), story.simulated, story.seconds,
      story.deepest > 0 ? fmt::format("more than {:.3f} R ", std::ceil(1000 * story.deepest) / 1000) : "");
  html += figures(story.falling, "row");
  return html + "<div class=\"wide\">\n" + figure(story.heap_hulls) + "</div>\n";
}

}  // namespace demo
