#include "partwise/imaging/tone_mapping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr float middle_grey = 0.18f, gamma = 2.2f;

int colours(const Image& image) { return image.channels <= 2 ? 1 : 3; }

}  // namespace

float exposure_by_median(const Image& linear, const Mask& foreground) {
  PARTWISE_CHECK(linear.width, ==, foreground.width);
  PARTWISE_CHECK(linear.height, ==, foreground.height);
  PARTWISE_CHECK(foreground.channels, ==, 1);
  std::vector<float> values;
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x) {
      if (foreground.pixel(x, y)[0] > 0.5f) {
        values.insert(values.end(), linear.pixel(x, y), linear.pixel(x, y) + colours(linear));
      }
    }
  }
  if (values.empty()) return 1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  double level = *middle;
  if (!(level > 0)) level = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  const auto exposure = static_cast<float>(middle_grey / level);
  return exposure > 0 && std::isfinite(exposure) ? exposure : 1;
}

Image tone_map(const Image& linear, float exposure) {
  Image mapped = linear;
  const auto channels = static_cast<std::size_t>(linear.channels);
  for (std::size_t i = 0; i < mapped.values.size(); ++i) {
    const bool is_alpha = static_cast<int>(i % channels) >= colours(linear);
    const float value = std::clamp(is_alpha ? mapped.values[i] : exposure * mapped.values[i], 0.0f, 1.0f);
    mapped.values[i] = 255 * (is_alpha ? value : std::pow(value, 1 / gamma));
  }
  return mapped;
}

}  // namespace partwise
