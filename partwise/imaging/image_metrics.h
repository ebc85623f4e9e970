// How far an image is from the true one: squared error, PSNR, SSIM, over the whole frame or over a mask; and the
// relative error of linear images.
//
// The first three of tone-mapped images, values 0..255 (tone_mapping.h). The squared error is per pixel, averaged over
// the channels. SSIM: Wang, Bovik, Sheikh, Simoncelli 2004: an 11 x 11 Gaussian of sigma 1.5, K1 = 0.01, K2 = 0.03,
// only windows that lie in the frame, averaged over the channels; over a mask, the windows whose centre is in it. Sums
// are in double, in one order. Errors: CheckFailed for sizes that do not fit.
#pragma once

#include <optional>

#include "partwise/imaging/image.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {

struct ImageDifference {
  double squared_error = 0;
  double psnr = 0;             // decibels at a peak of 255; infinite for equal images
  std::optional<double> ssim;  // none where no window has its centre among the pixels that count
};

ImageDifference compare_images(const Image& image, const Image& truth);
// Over the pixels of the mask; it must have one.
ImageDifference compare_images(const Image& image, const Image& truth, const Mask& mask);

// Sum of the absolute differences over the sum of the true values: of linear images, whatever their exposure.
double relative_error(const Image& image, const Image& truth);

}  // namespace partwise
