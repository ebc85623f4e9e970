#include "partwise/imaging/image.h"

#include <cmath>

#include "partwise/base/error.h"

namespace partwise {

Image::Image(int width_, int height_, int channels_, float value)
    : width(width_), height(height_), channels(channels_) {
  PARTWISE_CHECK(width, >=, 1);
  PARTWISE_CHECK(height, >=, 1);
  PARTWISE_CHECK(channels, >=, 1);
  PARTWISE_CHECK(channels, <=, 4);
  values.assign(offset(0, height), value);
}

float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

}  // namespace partwise
