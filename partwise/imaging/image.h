// Images in memory: row-major, interleaved channels, 32-bit float, linear light. Row 0 is the top.
//
// Channels: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha. Alpha is straight (colours are not multiplied by it), as
// PNG has it. Values are usually in [0, 1], where 1 is display white; nothing clamps until a file format has to.
// The transfer curve between linear light and sRGB is IEC 61966-2-1's.
#pragma once

#include <cstddef>
#include <vector>

namespace partwise {

struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;  // height x width x channels

  Image() = default;
  // Errors: CheckFailed unless width and height are at least 1 and channels is 1 to 4.
  Image(int width, int height, int channels, float value = 0);

  float* pixel(int x, int y) { return values.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return values.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);

}  // namespace partwise
