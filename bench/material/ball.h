// A ball of a material under lights from far away, viewed along -z from afar: the exact sum (3.2) over the pixels of
// small maps, for any Brdf alike. Shares nothing with the renderer of the library.
#pragma once

#include <string>
#include <vector>

#include "partwise/appearance/material/brdf.h"
#include "partwise/imaging/image.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise::bench {

// An equirectangular map of light (docs/conventions.md), averaged down to 48 x 24 pixels.
struct SmallLight {
  static constexpr int width = 48, height = 24;
  std::vector<Eigen::Vector3f> radiance;  // row by row, times the pixel's solid angle
};

SmallLight small_light(const std::string& file);

inline constexpr int ball_size = 40;  // pixels a side; the ball touches the frame

// One image a light: the material is asked once for each pair of normal and direction.
std::vector<Image> balls(const Brdf& material, const std::vector<SmallLight>& lights);
Mask ball_mask();

}  // namespace partwise::bench
