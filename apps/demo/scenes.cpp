#include "scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "history.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/base/shared_files.h"
#include "partwise/normals/prediction/photo_normals.h"
#include "partwise/normals/scenes/room_picture.h"

namespace demo {
namespace {

using namespace partwise;

constexpr double unit_height = 0.8;  // metres, of a model whose box is a cube

// Stands as high as it is wide and deep in the mean.
Furniture furniture_of(const WornModel& model) {
  Furniture piece{model.mesh, model.parts, 1 + *std::ranges::max_element(model.parts)};
  const Eigen::RowVector3d size = model.mesh.vertices.colwise().maxCoeff() - model.mesh.vertices.colwise().minCoeff();
  piece.mesh.vertices *= unit_height / std::cbrt(size.prod());
  return piece;
}

Image as_colours(const Image& normals) {
  Image codes(normals.width, normals.height, 3);
  std::ranges::transform(normals.values, codes.values.begin(), [](float value) { return (value + 1) / 2; });
  return from_codes(codes);
}

// As a camera shows it: the codes of sRGB, the median at a grey card.
Image exposed(Image linear) {
  std::vector<float> greens;
  for (std::size_t i = 1; i < linear.values.size(); i += 3) greens.push_back(linear.values[i]);
  std::ranges::nth_element(greens, greens.begin() + std::ssize(greens) / 2);
  const float grey = 0.18f / std::max(greens[greens.size() / 2], 1e-6f);
  for (float& value : linear.values) value = srgb_from_linear(std::min(1.0f, grey * value));
  return linear;
}

struct Reader {
  const char* name;
  NormalPredictor network;
  NormalMeasure measure{};
};

}  // namespace

ScenesStory tell_scenes(std::span<const WornModel> models) {
  std::array readers{
      Reader{"Found, by normals alone", read_scene_predictor(shared_file("models/networks/scenes_standalone.pt"))},
      Reader{"Found, by the picture too", read_scene_predictor(shared_file("models/networks/scenes.pt"))}};
  std::vector<Furniture> furniture;
  std::ranges::transform(models, std::back_inserter(furniture), furniture_of);
  std::vector<DsbrdfCoefficients> materials;
  for (const std::string& name : test_materials()) materials.push_back(shipped_material(name).brdf.coefficients());
  const std::array<const char*, 3> lights{"lobby", "venice", "sunrise"};

  ScenesStory story;
  NormalMeasure sensor;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Draw draw(7, i, 0);
    const Room room = drawn_room(furniture, draw, {.least_pieces = 8, .most_pieces = 12});
    const RoomPicture picture =
        room_picture(room, drawn_wear(room.parts, materials, draw), resized_light(lights[i], 32), {.seed = i});
    const Image shown = exposed(picture.image);
    story.pictures.push_back(make_picture(from_codes(shown), "Room", "A furnished room"));
    story.pictures.push_back(make_picture(as_colours(picture.noisy_normals), "Of a depth sensor",
                                          "Normals that a depth sensor tells, with holes, as colours"));
    sensor.add(picture.noisy_normals, picture.normals);
    for (Reader& reader : readers) {
      const Image found = scene_normals(reader.network, shown);
      reader.measure.add(found, picture.normals);
      story.pictures.push_back(make_picture(as_colours(found), reader.name, fmt::format("Normals: {}", reader.name)));
    }
    story.pictures.push_back(make_picture(as_colours(picture.normals), "True", "The true normals, as colours"));
  }
  story.sensor = sensor.errors();
  story.standalone = readers[0].measure.errors();
  story.combined = readers[1].measure.errors();
  return story;
}

std::string scenes_chapter(const ScenesStory& story) {
  const nlohmann::json run =
      newest_run("scenes", [](const nlohmann::json& each) { return each.at("found").contains("combined"); });
  const auto row = [&](const char* name, const char* key) {
    const nlohmann::json& found = run.at("found").at(key);
    const auto angle = [&](const char* region) {
      return fmt::format("{:.1f}&deg;", found.at(region).at("mean").get<double>());
    };
    return Row{name, angle("all"), angle("right"), angle("wrong"), angle("missing")};
  };
  return R"(<h2>The shape of a room</h2>
<p class="lead">A depth sensor tells normals with errors, and none at edges, at flat angles and on what mirrors. Networks that learn from nothing else
give an answer everywhere: a better one than the sensor at edges and where it is blind, a far worse one where it sees.</p>
)" + figures(story.pictures, "rooms") +
         "<h3>Against the true normals</h3>\n" +
         table(
             {"", "all", "right", "wrong", "blind"},
             {row("depth sensor", "sensor"), row("normals alone", "standalone"), row("the picture too", "combined")}) +
         fmt::format(
             "<p class=\"note\">{} rooms of furniture, materials and lights that no network has seen, measured on {}; "
             "mean angles to the true normals, a missing one counts as 90&deg;; right and wrong: where the sensor is "
             "off by "
             "less or more than 11.25&deg;; blind: where it tells nothing. The dissertation could not measure "
             "this: real rooms have no true normals. In the three rooms above, measured now: {:.1f}&deg;, {:.1f}&deg; "
             "and {:.1f}&deg;.</p>\n",
             run.at("count").get<int>(), date_of(run), story.sensor.mean, story.standalone.mean, story.combined.mean);
}

}  // namespace demo
