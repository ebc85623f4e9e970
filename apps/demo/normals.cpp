#include "normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "partwise/appearance/palette.h"
#include "partwise/base/shared_files.h"
#include "partwise/normals/prediction/photo_normals.h"
#include "taken.h"

namespace demo {
namespace {

using namespace partwise;
using Clock = std::chrono::steady_clock;

constexpr float largest_angle = 60;  // degrees, in yellow

Eigen::Vector3f normal_at(const Image& normals, std::size_t pixel) {
  return Eigen::Map<const Eigen::Vector3f>(&normals.values[3 * pixel]);
}

void tell_model(const Taken& picture, const std::string& name, const Image& found, NormalsStory& story) {
  const Image mask = picture.seen.mask_image(), truth = picture.seen.normal_image();
  const auto angle = [&](std::size_t i) {
    const float cosine = std::clamp(normal_at(found, i).dot(normal_at(truth, i)), -1.0f, 1.0f);
    return std::acos(cosine) * 180 / std::numbers::pi_v<float>;
  };
  story.pictures.push_back(
      make_picture(from_codes(picture.photo.shown), name, fmt::format("{} in {}", name, picture.materials[0])));
  story.pictures.push_back(make_picture(
      from_codes(masked(mask, [&](std::size_t i) -> Eigen::Vector3f { return (normal_at(found, i).array() + 1) / 2; })),
      "Found", fmt::format("{}: the normals that were found, as colours", name)));
  story.pictures.push_back(
      make_picture(normals_of(picture.seen), "True", fmt::format("{}: the true normals, as colours", name)));
  story.pictures.push_back(
      make_picture(masked(mask, [&](std::size_t i) { return value_colour(angle(i) / largest_angle); }), "Apart",
                   fmt::format("{}: the angle between them, from dark blue to yellow", name)));
}

}  // namespace

NormalsStory tell_normals(std::span<const WornModel> models) {
  const NormalPredictor network = read_normal_predictor(shared_file("models/networks/objects.pt"));
  const std::vector<std::string> worn = {"specular-orange-phenolic", "white-fabric", "blue-metallic-paint"};
  const std::vector<std::string> lights = {"lobby", "venice", "sunrise"};
  NormalsStory story;
  NormalMeasure measure;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Taken picture = taken(whole(models[i]), {worn[i % worn.size()]}, lights[i % lights.size()], 35);
    const Clock::time_point start = Clock::now();
    const Image found = photo_normals(network, picture.photo);
    story.look_seconds +=
        std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(models.size());
    measure.add(found, picture.seen.normal_image());
    tell_model(picture, models[i].name, found, story);
  }
  story.errors = measure.errors();
  return story;
}

std::string normals_chapter(const NormalsStory& story) {
  const NormalErrors& errors = story.errors;
  return R"(<h2>The shape on one photo</h2>
<p class="lead">The same images teach a network to tell the direction of the surface at every pixel of a single picture: red to the right, green up,
blue to the viewer.</p>
)" + figures(story.pictures, "row four") +
         fmt::format(
             "<p>On the right, how far apart found and true normals are, from dark blue for 0 to yellow for {:.0f} "
             "degrees. Looking at a picture "
             "takes {:.2f} s. No material and no light here is one that it learnt from.</p>\n",
             largest_angle, story.look_seconds) +
         "<h3>Beside the dissertation&rsquo;s Table 4.1</h3>\n" +
         table({"", "cosine, mean", "angle, median", "below 22.5&deg;"},
               {{"dissertation", "0.9050", "", ""},
                {"these pictures", fmt::format("{:.4f}", errors.cosine), fmt::format("{:.1f}&deg;", errors.median),
                 fmt::format("{:.0f} %", 100 * errors.share_below[3])}}) +
         "<p class=\"note\">The dissertation&rsquo;s network, trained with the rendering layer, on its synthetic "
         "pictures; ours on the pictures above, "
         "measured now.</p>\n";
}

}  // namespace demo
