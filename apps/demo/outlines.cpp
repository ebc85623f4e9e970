#include "outlines.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "partwise/base/shared_files.h"
#include "partwise/parts/planar/outline_pictures.h"
#include "partwise/parts/planar/read_shape.h"
#include "partwise/parts/planar/segmentation_measures.h"
#include "partwise/parts/planar/skeleton.h"
#include "scan.h"

namespace demo {
namespace {

using partwise::Outline;
using partwise::Polygons;
using partwise::Ring;

constexpr double tolerance = 0.05;

Polygons read_outline(std::string_view file) {
  return partwise::read_shape(partwise::shared_file("data/outlines") / file, {.lenient = true}).polygons;
}

// A quarter turn, for what stands upright.
void lay_down(Polygons& polygons) {
  const auto turn = [](Ring& ring) {
    ring.col(0).swap(ring.col(1));
    ring.col(0) *= -1;
  };
  for (partwise::Polygon& polygon : polygons) {
    turn(polygon.outer);
    for (Ring& hole : polygon.holes) turn(hole);
  }
}

int corners_of(const Polygons& polygons) {
  Eigen::Index count = 0;
  for (const partwise::Polygon& polygon : polygons) {
    count += polygon.outer.rows();
    for (const Ring& hole : polygon.holes) count += hole.rows();
  }
  return static_cast<int>(count);
}

double seconds_of(const Outline& outline) {
  double sum = 0;
  for (const auto& [stage, seconds] : outline.seconds) sum += seconds;
  return sum;
}

Picture parts_picture(const Outline& outline, bool y_down, double size, std::string caption, std::string description) {
  return make_drawing(partwise::outline_svg(outline, {.y_down = y_down, .size = size, .ground = false}),
                      std::move(caption), std::move(description));
}

Picture skeleton_picture(const Polygons& shape, const Outline& outline, std::string caption, std::string description) {
  const partwise::Skeleton skeleton = partwise::extract_skeleton(outline);
  return make_drawing(partwise::skeleton_svg(shape, skeleton, {.size = 600, .ground = false}), std::move(caption),
                      std::move(description));
}

void tell_clean(OutlineStory& story) {
  constexpr std::array<std::array<std::string_view, 2>, 4> shapes{
      {{"bird.poly", "Bird"}, {"mammoth.poly", "Mammoth"}, {"hole3.poly", "Three holes"}, {"neuron.poly", "Neuron"}}};
  for (const auto& [file, name] : shapes) {
    Polygons shape = read_outline(file);
    if (name == "Neuron") lay_down(shape);
    const Outline outline = partwise::decompose_outline(shape, {.tolerance = tolerance});
    story.clean.push_back(
        parts_picture(outline, false, 600,
                      fmt::format("{}: {} parts, {:.0f} ms", name, outline.parts.size(), 1000 * seconds_of(outline)),
                      fmt::format("{}: parts in colours, cuts as red lines", name)));
    story.skeletons.push_back(skeleton_picture(shape, outline, fmt::format("{}: its skeleton", name),
                                               fmt::format("{}: the skeleton from part to part", name)));
  }
}

// The mammoth as a scan of 640 pixels, ragged and speckled, back in its own coordinates.
Polygons noisy_version(const Polygons& shape) {
  const Eigen::AlignedBox2d box = partwise::bounding_box(shape);
  constexpr double margin = 12;
  const double scale = 640 / box.sizes().x();
  Scan scan(static_cast<int>(640 + 2 * margin), static_cast<int>(scale * box.sizes().y() + 2 * margin));
  const auto map = [&](Ring ring, bool to_pixels) {
    if (to_pixels) {
      ring.col(0) = margin + scale * (ring.col(0).array() - box.min().x());
      ring.col(1) = margin + scale * (box.max().y() - ring.col(1).array());
    } else {
      ring.col(0) = box.min().x() + (ring.col(0).array() - margin) / scale;
      ring.col(1) = box.max().y() - (ring.col(1).array() - margin) / scale;
    }
    return ring;
  };
  for (const partwise::Polygon& polygon : shape) {
    std::vector<Ring> rings{map(polygon.outer, true)};
    for (const Ring& hole : polygon.holes) rings.push_back(map(hole, true));
    scan.paint(rings);
  }
  scan.roughen(2.4, 60, 5);
  Polygons noisy = scan.outlines();
  for (partwise::Polygon& polygon : noisy) {
    polygon.outer = map(polygon.outer, false);
    for (Ring& hole : polygon.holes) hole = map(hole, false);
  }
  partwise::normalise(noisy);  // y was turned, and with it all directions
  return noisy;
}

void tell_noisy(OutlineStory& story) {
  const Polygons shape = read_outline("mammoth.poly"), noisy = noisy_version(shape);
  const partwise::OutlineSettings settings{.tolerance = 0.1};
  const Outline clean = partwise::decompose_outline(shape, settings);
  const Outline rough = partwise::decompose_outline(noisy, settings);
  const auto grid = [&](const Outline& outline) {
    const partwise::Circle circle = partwise::enclosing_circle(shape);
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(circle.radius);
    return partwise::label_grid(outline.parts, circle.centre - reach, circle.centre + reach);
  };
  story.rand_index = partwise::rand_index(grid(clean), grid(rough));
  story.noise_holes = rough.holes_noise();
  story.noisy.push_back(parts_picture(clean, false, 900,
                                      fmt::format("{} corners, {} parts", corners_of(shape), clean.parts.size()),
                                      "The mammoth, cut into parts"));
  story.noisy.push_back(parts_picture(rough, false, 900,
                                      fmt::format("A bad scan: {} corners, {} holes, {} parts", corners_of(noisy),
                                                  rough.holes.size(), rough.parts.size()),
                                      "A ragged, speckled mammoth, cut into parts"));
}

Polygons make_herd(std::span<const partwise::Mesh* const> meshes) {
  constexpr int width = 1800, height = 360, animals = 13;
  std::mt19937_64 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Scan scan(width, height);
  const double ground = height - 40;
  for (int i = 0; i < animals; ++i) {
    const partwise::Mesh& mesh = *meshes[static_cast<std::size_t>(i) % meshes.size()];
    const double x = 160 + i * (width - 320.0) / (animals - 1) + uniform(-14, 14);
    scan.paint_silhouette(mesh, x, ground + uniform(0, 12), uniform(170, 270), random() % 2 == 0);
  }
  Ring earth(4, 2);
  earth << 14, ground - 2, width - 14, ground - 2, width - 14, height - 14, 14, height - 14;
  scan.paint(std::vector{earth});
  scan.roughen(1.6, 150, 3);
  return scan.outlines();
}

void tell_herd(OutlineStory& story, std::span<const partwise::Mesh* const> meshes) {
  const Polygons herd = make_herd(meshes);
  const Outline outline = partwise::decompose_outline(herd, {.tolerance = 0.02});
  story.herd =
      parts_picture(outline, true, 1400,
                    fmt::format("{} corners, {} holes that are structure and {} that are noise: {} parts in {:.2f} s",
                                corners_of(herd), outline.holes_kept(), outline.holes_noise(), outline.parts.size(),
                                seconds_of(outline)),
                    "The silhouette of a herd of animals, cut into coloured parts");
}

}  // namespace

OutlineStory tell_outlines(std::span<const partwise::Mesh* const> herd) {
  OutlineStory story;
  story.tolerance = tolerance;
  tell_clean(story);
  tell_noisy(story);
  tell_herd(story, herd);
  return story;
}

std::string outlines_chapter(const OutlineStory& story) {
  std::string html = fmt::format(
      R"(<h2>And in the plane</h2>
<p>Outlines, silhouettes and floor plans are cut along diagonals between their own corners. No corner of a part is farther than {:.2f} R from the
bridge over its pocket, R the radius of the smallest circle around the shape. A skeleton runs from part to part through the cuts.</p>
)",
      story.tolerance);
  html += figures(story.clean, "row even") + figures(story.skeletons, "row even gap");
  html += fmt::format(
      R"(<h3>Noise changes little</h3>
<p>On the right, the edge of the same animal has been made ragged and its body speckled. The {} small holes count as noise: they stay holes, but no
cut is made for them. At 0.10 R the two decompositions agree to a Rand index of {:.2f}.</p>
)",
      story.noise_holes, story.rand_index);
  html += figures(story.noisy, "row even");
  return html + R"(<h3>A crowd</h3>
<p>Models from this page on one line, seen from the side: legs and bodies overlap and enclose gaps that matter, specks and ragged edges that do not.</p>
)" + "<div class=\"wide strip\">\n" +
         figure(story.herd) + "</div>\n";
}

std::string outline_credits() {
  return "<p>The outlines of bird, mammoth, neuron and the shape with three holes are examples of acd2d by Jyh-Ming "
         "Lien "
         "(MIT licence).</p>\n";
}

}  // namespace demo
