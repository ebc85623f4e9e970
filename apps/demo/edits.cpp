#include "edits.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <initializer_list>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/appearance/shapes/part_groups.h"
#include "partwise/base/shared_files.h"
#include "partwise/editing/edit_photo.h"
#include "partwise/editing/layer_pictures.h"
#include "partwise/imaging/image_metrics.h"
#include "partwise/imaging/tile.h"
#include "partwise/imaging/tone_mapping.h"
#include "taken.h"

namespace demo {
namespace {

using namespace partwise;
using Clock = std::chrono::steady_clock;

constexpr int layer_size = 128;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Picture as_picture(const Image& codes, std::string caption, std::string description) {
  return make_picture(from_codes(codes), std::move(caption), std::move(description));
}

Image of_display(Image shown) {  // 0 to 255
  for (float& value : shown.values) value *= 255;
  return shown;
}

void tell_layers(const Taken& picture, const PhotoLayers& layers, const MaterialRange& range, EditsStory& story) {
  Image ball =
      tone_map(material_ball(brdfs_of(picture.materials)[0], LightTree(picture.light), layer_size), picture.exposure);
  for (float& value : ball.values) value /= 255;
  story.layers = {
      as_picture(square_picture(picture.photo.shown, layers), "The picture", "A toy car in red plastic"),
      as_picture(rendered_picture(layers, range), "Rendered anew", "The car rendered from what was found"),
      as_picture(normals_picture(layers), "Normals found", "The normals that the networks found, as colours"),
      make_picture(normals_of(picture.seen), "True normals", "The true normals, as colours"),
      as_picture(ball_picture(layers, range, 0, layer_size), "Material and light found",
                 "A ball in the material and under the light that were found"),
      as_picture(ball, "True material and light", "A ball in the true material and under the true light")};
}

void tell_car(const WornModel& car, const EditingNetworks& networks, EditsStory& story) {
  const Taken picture = taken(whole(car), {"red-specular-plastic"}, "venice", 40);
  Clock::time_point start = Clock::now();
  story.error = read_layers(networks, picture.photo).error;
  story.look_seconds = seconds_since(start);
  start = Clock::now();
  ReadingSettings settings;
  settings.refine = true;
  const PhotoLayers layers = read_layers(networks, picture.photo, settings);
  story.refine_seconds = seconds_since(start);
  story.refined_error = layers.error;
  tell_layers(picture, layers, networks.range(), story);
  std::vector<Image> strip = {picture.photo.shown};
  for (const std::string name :
       {"gold-metallic-paint", "chrome", "brass", "blue-metallic-paint", "white-marble", "specular-orange-phenolic"}) {
    strip.push_back(edited(picture.photo, layers, {shipped_material(name).brdf.coefficients()}));
    story.edits.push_back(as_picture(strip.back(), name, fmt::format("The same car in {}", name)));
    const Image truth = taken(whole(car), {name}, "venice", 40).photo.shown;
    story.truths.push_back(as_picture(truth, "truly " + name, fmt::format("A car that truly is of {}", name)));
    story.differences.push_back(
        compare_images(of_display(exposed_anew(strip.back(), picture.photo.regions[0])), of_display(truth)));
  }
  strip.resize(6);
  story.strip = from_codes(tile(strip, 3));
}

// Row by row: shape and light of the row's picture, material of the column's.
void tell_swaps(std::span<const WornModel> models, const EditingNetworks& networks, EditsStory& story) {
  const std::vector<std::string> worn = {"aluminium", "pink-fabric", "specular-orange-phenolic",
                                         "green-metallic-paint"};
  const std::vector<std::string> lights = {"lobby", "sunrise", "venice", "night"};
  std::vector<Taken> pictures;
  std::vector<PhotoLayers> layers;
  for (std::size_t i = 0; i < models.size(); ++i) {
    pictures.push_back(taken(whole(models[i]), {worn[i % worn.size()]}, lights[i % lights.size()], 40));
    layers.push_back(read_layers(networks, pictures.back().photo));
  }
  for (std::size_t row = 0; row < pictures.size(); ++row) {
    for (std::size_t column = 0; column < pictures.size(); ++column) {
      const DsbrdfCoefficients material = as_material(networks.range().coefficients(layers[column].found.material)[0]);
      const bool itself = row == column;
      story.swaps.push_back(as_picture(
          itself ? pictures[row].photo.shown : edited(pictures[row].photo, layers[row], {material}),
          itself ? fmt::format("{}: the picture", models[row].name) : fmt::format("as the {}", models[column].name),
          itself ? fmt::format("{} in {}", models[row].name, pictures[row].materials[0])
                 : fmt::format("{} in the material found on the {}", models[row].name, models[column].name)));
    }
  }
}

void tell_parts(WornModel chair, const EditingNetworks& networks, EditsStory& story) {
  const PartGroups groups = group_parts(chair.mesh, chair.parts, 3);
  chair.parts = groups.of_face;
  const std::vector<std::string> names = {"natural-209", "beige-fabric", "black-soft-plastic"};
  const Taken picture = taken(chair, {names.begin(), names.begin() + groups.count}, "lobby", 35, /*parts_apart=*/true);
  const PhotoLayers layers = read_layers(networks, picture.photo);
  story.parts.push_back(as_picture(picture.photo.shown, "The picture", "A chair in several materials"));
  for (const std::array<const char*, 3>& wanted : std::initializer_list<std::array<const char*, 3>>{
           {"chrome", "red-fabric", "black-obsidian"},
           {"gold-metallic-paint", "white-fabric", "brass"},
           {"blue-metallic-paint", "specular-yellow-phenolic", "steel"}}) {
    std::vector<DsbrdfCoefficients> materials;
    for (std::size_t i = 0; i < picture.materials.size(); ++i)
      materials.push_back(shipped_material(wanted[i]).brdf.coefficients());
    const std::string caption = fmt::format("{}", fmt::join(wanted.begin(), wanted.begin() + groups.count, ", "));
    story.parts.push_back(
        as_picture(edited(picture.photo, layers, materials), caption, "The same chair in " + caption));
  }
}

// Means over the edits of the car.
std::string beside(const EditsStory& story) {
  double error = 0, likeness = 0;
  const auto count = static_cast<double>(story.differences.size());
  for (const ImageDifference& each : story.differences) {
    error += each.squared_error / count;
    likeness += each.ssim.value_or(0) / count;
  }
  return "<h3>Beside the dissertation&rsquo;s Table 3.2</h3>\n" +
         table({"another material", "squared error", "SSIM"},
               {{"Lombardi and Nishino", "802.7", "0.9416"},
                {"the dissertation&rsquo;s network", "805.2", "0.9408"},
                {"the same, refined", "530.9", "0.9557"},
                {"ours, refined: the cars above", fmt::format("{:.1f}", error), fmt::format("{:.4f}", likeness)}}) +
         "<p class=\"note\">Of values from 0 to 255, over the whole picture. The dissertation&rsquo;s are means over "
         "500 pictures; ours is measured "
         "now, on the pictures above alone, each exposed by its own median.</p>\n";
}

}  // namespace

EditsStory tell_edits(const WornModel& car, const WornModel& chair, std::span<const WornModel> swapped) {
  const Clock::time_point start = Clock::now();
  EditsStory story;
  const EditingNetworks networks = read_editing_networks(shared_file("models/networks/editing.pt"));
  tell_car(car, networks, story);
  tell_swaps(swapped, networks, story);
  tell_parts(chair, networks, story);
  story.seconds = seconds_since(start);
  return story;
}

std::string edits_chapter(const EditsStory& story) {
  return R"(<h2>One picture in, any material out</h2>
<p class="lead">Networks that learnt from such images read normals, material and light off a single picture; the object is then rendered again in
another material. The pictures here are renderings too, under lights that the networks never saw: so the truth is known and stands beside what was
found.</p>
<h3>A car in other materials</h3>
<p>Above the edits, below the same car truly in these materials. What colour the light has cannot be told from a picture of red plastic: under the blue
sky of this one the truth is bluer.</p>
)" + figures(story.edits, "row five") +
         figures(story.truths, "row five gap") + beside(story) +
         R"(<h3>What was found</h3>
)" +
         fmt::format(
             "<p>What the networks see is 128 x 128 pixels. Looking takes {:.1f} s; then L-BFGS makes what was found "
             "explain "
             "the picture better, in {:.1f} s: the mean squared error over the object, of values from 0 to 255, falls "
             "from "
             "{:.0f} to {:.0f}.</p>\n",
             story.look_seconds, story.refine_seconds, story.error, story.refined_error) +
         figures(story.layers, "row five") +
         R"(<h3>Materials swapped</h3>
<p>Each row has the shape and the light of one picture, each column the material that was found in one; the pictures themselves are on the diagonal.</p>
)" + figures(story.swaps, "row four") +
         R"(<h3>Part by part</h3>
<p>With a mask for each part, each has a material of its own; normals and light are one for all.</p>
)" + figures(story.parts, "row") +
         fmt::format("<p class=\"note\">Read and drawn in {:.0f} seconds.</p>\n", story.seconds);
}

}  // namespace demo
