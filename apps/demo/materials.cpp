#include "materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <numbers>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/appearance/shapes/part_groups.h"
#include "partwise/appearance/synthesis/sample_plan.h"
#include "partwise/imaging/tile.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/parts/surface/segmentation.h"
#include "views.h"

namespace demo {
namespace {

using namespace partwise;
using Clock = std::chrono::steady_clock;

constexpr int ball_size = 96, chair_size = 300, channel_size = 240, sample_size = 128;
constexpr int light_rows = 128;  // of mirrors and what one looks at closely; random images take half as many

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<std::string> for_parts(const std::vector<std::string>& names, int parts) {
  std::vector<std::string> worn;
  worn.reserve(static_cast<std::size_t>(parts));
  for (int part = 0; part < parts; ++part) worn.push_back(names[static_cast<std::size_t>(part) % names.size()]);
  return worn;
}

// A ball shows its reflectance map, so that one texel a pixel is enough for balls as small as these.
std::vector<Picture> tell_balls() {
  const EnvironmentLight light = resized_light("studio", light_rows);
  const LightTree tree(light);
  const float exposure = grey_card_exposure(light);
  const GBuffer seen = ball_view(ball_size, 16);
  const Image mask = seen.mask_image();
  std::vector<Picture> balls;
  for (const std::string& name : shipped_materials()) {
    const ReflectanceMap map(PatchSum(shipped_material(name).brdf, tree), ball_size);
    const std::array worn{&map};
    balls.push_back(make_picture(for_the_eye(on_clear_ground(mapped_image(seen, worn), mask), exposure), name,
                                 "A ball in " + name));
  }
  return balls;
}

std::vector<Picture> tell_chairs(WornModel chair) {
  const std::vector<int> pieces = segment(chair.mesh, {.feature = SurfaceFeature::visibility_average}).labels;
  const PartGroups groups = group_parts(chair.mesh, pieces, 3);
  chair.parts = groups.of_face;
  const GBuffer seen = view_of(chair, 35, chair_size, 0.4);
  const EnvironmentLight light = resized_light("lobby", light_rows);
  std::vector<Picture> pictures;
  for (const std::vector<std::string>& names :
       std::initializer_list<std::vector<std::string>>{{"chrome", "red-fabric", "black-obsidian"},
                                                       {"natural-209", "green-fabric", "cherry-235"},
                                                       {"gold-metallic-paint", "white-fabric", "brass"},
                                                       {"blue-metallic-paint", "specular-yellow-phenolic", "steel"},
                                                       {"white-marble", "black-fabric", "aluminium"},
                                                       {"dark-red-paint", "beige-fabric", "colonial-maple-223"}}) {
    const std::vector<std::string> worn = for_parts(names, groups.count);
    pictures.push_back(make_picture(worn_picture(seen, brdfs_of(worn), light, true),
                                    fmt::format("{}", fmt::join(worn, ", ")),
                                    fmt::format("A chair in {}", fmt::join(worn, ", "))));
  }
  return pictures;
}

void tell_channels(WornModel car, MaterialsStory& story) {
  const PartGroups groups = group_parts(car.mesh, car.parts, 4);
  car.parts = groups.of_face;
  const GBuffer seen = view_of(car, 40, channel_size, 0.42);
  const std::vector<Dsbrdf> worn =
      brdfs_of(for_parts({"red-metallic-paint", "black-soft-plastic", "chrome", "gold-paint"}, groups.count));
  const auto image = [&](const std::string& light) {
    return worn_picture(seen, worn, resized_light(light, light_rows), true);
  };
  story.channels = {make_picture(image("venice"), "Image", "A toy car in four materials"),
                    make_picture(normals_of(seen), "Normals", "Its normals as colours"),
                    make_picture(depth_of(seen), "Depth", "Its depth, near bright and far dark"),
                    make_picture(mask_of(seen), "Mask", "What it covers"),
                    make_picture(parts_of(seen), "Parts", "Its parts in colours")};
  for (const char* light : {"studio", "lobby", "park", "sunrise", "city"})
    story.lights.push_back(make_picture(image(light), light, fmt::format("The toy car under the light {}", light)));
}

std::vector<Picture> tell_samples(std::span<const WornModel> models) {
  constexpr int count = 60, most_parts = 4;
  const std::vector<std::string> names = shipped_materials(), lights = shipped_lights();
  std::vector<WornModel> worn(models.begin(), models.end());
  std::vector<int> parts;
  for (WornModel& model : worn) {
    const PartGroups groups = group_parts(model.mesh, model.parts, most_parts);
    model.parts = groups.of_face;
    parts.push_back(groups.count);
  }
  SamplePlan plan{.seed = 7,
                  .shapes = static_cast<int>(models.size()),
                  .materials = static_cast<int>(names.size()),
                  .lights = static_cast<int>(lights.size()),
                  .parts = [&](int shape) { return parts[static_cast<std::size_t>(shape)]; },
                  .views = 1};
  std::vector<EnvironmentLight> maps;
  maps.reserve(lights.size());
  for (const std::string& light : lights) maps.push_back(resized_light(light, light_rows / 2));
  std::vector<Picture> pictures;
  for (int number = 0; number < count; ++number) {
    const Sample drawn = sample(plan, static_cast<std::uint64_t>(number));
    const WornModel& model = worn[static_cast<std::size_t>(drawn.shape)];
    std::vector<std::string> materials;
    for (const int material : drawn.materials) materials.push_back(names[static_cast<std::size_t>(material)]);
    const GBuffer seen = view_of(model, 360.0 / plan.viewpoints * drawn.viewpoint, sample_size, 0.45);
    const EnvironmentLight light =
        maps[static_cast<std::size_t>(drawn.light)].rotated(drawn.light_turn * 180 / std::numbers::pi);
    const std::array images{worn_picture(seen, brdfs_of(materials), light, false), normals_of(seen), parts_of(seen)};
    pictures.push_back(make_picture(tile(images, 3), fmt::format("{}", fmt::join(materials, ", ")),
                                    fmt::format("{} in random materials under the light {}; its normals; its parts",
                                                model.name, lights[static_cast<std::size_t>(drawn.light)])));
  }
  return pictures;
}

}  // namespace

MaterialsStory tell_materials(std::span<const WornModel> models, const WornModel& chair, const WornModel& car) {
  const Clock::time_point start = Clock::now();
  MaterialsStory story;
  story.balls = tell_balls();
  story.ball_seconds = seconds_since(start) / static_cast<double>(story.balls.size());
  story.chairs = tell_chairs(chair);
  tell_channels(car, story);
  story.samples = tell_samples(models);
  story.seconds = seconds_since(start);
  return story;
}

std::string materials_chapter(const MaterialsStory& story) {
  return R"(<h2>Parts in real materials, under real light</h2>
<p class="lead">A hundred measured materials, 108 numbers each; fourteen real places as light; and parts that the program finds itself,
so that every image comes with its normals, depth, mask and parts.</p>
<h3>A hundred materials</h3>
<p>The materials of the MERL database as three lobes about the half-vector. All balls have one light and one exposure, that of a grey card.</p>
)" + figures(story.balls, "wall") +
         R"(<h3>One chair, many materials</h3>
<p>The chair is cut into parts by averaged visibility. Parts that look alike are one group, small ones join what they lie at, and each group
wears a material of its own.</p>
)" + figures(story.chairs, "row") +
         R"(<h3>What is known of each pixel</h3>
<p>Beside the image its normals, depth, mask and parts; below, the same car in other places.</p>
)" + figures(story.channels, "row five") +
         figures(story.lights, "row five gap") + fmt::format("<h3>{} random images</h3>\n", story.samples.size()) +
         R"(<p>Shape, viewpoint, materials, light and its turn are drawn by chance from a seed and a number. Each has its normals and parts beside it:
so networks are taught.</p>
)" + figures(story.samples, "row samples") +
         fmt::format("<p class=\"note\">Drawn in {:.0f} seconds; a ball takes {:.2f}.</p>\n", story.seconds,
                     story.ball_seconds);
}

std::string material_credits() {
  return "<p>The materials are fitted to networks of Neural-BRDF (MIT licence) that reproduce the MERL BRDF database; "
         "the "
         "lights are CC0.</p>\n";
}

}  // namespace demo
