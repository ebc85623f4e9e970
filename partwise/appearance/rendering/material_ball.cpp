#include "partwise/appearance/rendering/material_ball.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/pixel_samples.h"
#include "partwise/base/error.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {

GBuffer ball_view(int size, int samples) {
  PARTWISE_CHECK(size, >=, 1);
  PARTWISE_CHECK(samples, >=, 1);
  GBuffer seen{{size, size, samples}, {}, {}, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int i = 0; i < samples; ++i) {
        const Eigen::Vector2d place = sample_place(i, samples);
        const double right = 2 * (x + place.x()) / size - 1, up = 1 - 2 * (y + place.y()) / size;
        const double rest = 1 - right * right - up * up;
        const double front = std::sqrt(std::max(rest, 0.0));
        seen.normals.push_back(rest > 0 ? Eigen::Vector3d(right, up, front).cast<float>().eval()
                                        : Eigen::Vector3f::Zero().eval());
        seen.depths.push_back(rest > 0 ? static_cast<float>(2 - front) : 0);
        seen.parts.push_back(rest > 0 ? 0 : -1);
      }
    }
  }
  return seen;
}

Image material_ball(const Brdf& material, const LightTree& light, int size) {
  constexpr int samples = 16, least_texels = 128, most_texels = 1024;
  const GBuffer seen = ball_view(size, samples);
  const ReflectanceMap map(PatchSum(material, light), std::clamp(size, least_texels, most_texels));
  const std::array maps{&map};
  return on_clear_ground(mapped_image(seen, maps), seen.mask_image());
}

float grey_card_exposure(const EnvironmentLight& light) {
  constexpr int size = 24;
  constexpr double grey = 0.18;
  const MicrofacetBrdf card(Eigen::Vector3d::Constant(grey));
  const LightSamples samples = light_samples(light.resized(4 * size, 2 * size));
  const LightSum sum(card, samples);
  const std::array sums{&sum};
  const GBuffer seen = ball_view(size, 1);
  return exposure_by_median(exact_image(seen, sums), seen.mask_image());
}

EnvironmentLight exposed_for_grey_card(const EnvironmentLight& light) {
  Image radiance = light.radiance();
  const float exposure = grey_card_exposure(light);
  for (float& value : radiance.values) value *= exposure;
  return EnvironmentLight(std::move(radiance));
}

}  // namespace partwise
