// Linear images for the eye, and for figures of error: one exposure, gamma 2.2, clamped to 0..255.
//
// The exposure takes the median of the foreground's values (all colour channels together) to middle grey, 0.18. Images
// that are compared share the exposure of the true one where errors of brightness are to count. Errors: CheckFailed for
// sizes that do not fit.
#pragma once

#include "partwise/imaging/image.h"

namespace partwise {

// Of images alike, the pixels that count: 1 where mask's one channel is above half.
using Mask = Image;

// What to multiply `linear` with. Where the median is 0 the mean takes its place; all black: 1.
float exposure_by_median(const Image& linear, const Mask& foreground);

// 255 clamp(exposure * value)^(1/2.2), not rounded; alpha is multiplied by 255 alone.
Image tone_map(const Image& linear, float exposure);

}  // namespace partwise
