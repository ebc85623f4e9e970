#include "partwise/appearance/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Eigen::Vector3f oklab(float lightness, float chroma, float hue_degrees) {
  const float hue = hue_degrees * std::numbers::pi_v<float> / 180;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

std::array<Eigen::Vector3f, part_colours> farthest_first() {
  std::vector<Eigen::Vector3f> candidates{oklab(0.66f, 0.09f, 250)};
  for (float lightness = 0.58f; lightness < 0.84f; lightness += 0.04f) {
    const float most = 0.105f - 0.16f * std::max(0.0f, lightness - 0.66f);  // light colours glare sooner
    for (float chroma = most; chroma > 0.03f; chroma -= 0.02f) {
      for (float hue = 0; hue < 360; hue += 10) {
        const Eigen::Vector3f lab = oklab(lightness, chroma, hue);
        const Eigen::Vector3f rgb = linear_from_oklab(lab);
        if (rgb.minCoeff() >= 0 && rgb.maxCoeff() <= 1) candidates.push_back(lab);
      }
    }
  }
  // Hue tells parts apart better than lightness, which the light of the scene changes as well.
  const auto distance = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return (a - b).cwiseProduct(Eigen::Vector3f(0.6f, 1, 1)).squaredNorm();
  };
  std::vector<float> nearest(candidates.size(), std::numeric_limits<float>::max());
  std::array<Eigen::Vector3f, part_colours> colours;
  std::size_t chosen = 0;
  for (Eigen::Vector3f& colour : colours) {
    colour = linear_from_oklab(candidates[chosen]);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      nearest[i] = std::min(nearest[i], distance(candidates[i], candidates[chosen]));
    }
    chosen = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
  }
  return colours;
}

}  // namespace

Eigen::Vector3f linear_from_oklab(const Eigen::Vector3f& lab) {
  const float l = lab[0] + 0.3963377774f * lab[1] + 0.2158037573f * lab[2];
  const float m = lab[0] - 0.1055613458f * lab[1] - 0.0638541728f * lab[2];
  const float s = lab[0] - 0.0894841775f * lab[1] - 1.2914855480f * lab[2];
  const float l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621f * l3 - 3.3077115913f * m3 + 0.2309699292f * s3,
          -1.2684380046f * l3 + 2.6097574011f * m3 - 0.3413193965f * s3,
          -0.0041960863f * l3 - 0.7034186147f * m3 + 1.7076147010f * s3};
}

Eigen::Vector3f value_colour(float value) {
  const float t = std::clamp(value, 0.0f, 1.0f);
  const Eigen::Vector3f lab = oklab(0.3f + 0.6f * t, 0.1f + 0.05f * t * t, 285 - 180 * t);
  return linear_from_oklab(lab).cwiseMax(0).cwiseMin(1);
}

Eigen::Vector3f part_colour(int index) {
  static const std::array<Eigen::Vector3f, part_colours> colours = farthest_first();
  PARTWISE_CHECK(index, >=, 0);
  return colours[static_cast<std::size_t>(index % part_colours)];
}

}  // namespace partwise
