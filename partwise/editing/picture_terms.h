// What losses and energies of pictures are made of.
//
// Shapes: images and values B x C x S x S, masks B x 1 x S x S of 0 and 1, maps of radiance B x 3 x h x w. A result "a
// row" has B numbers. Errors: CheckFailed for light that cannot be reduced to so many columns.
#pragma once

#include <ATen/core/Tensor.h>

#include "partwise/learning/perceptual_features.h"

namespace partwise {

// Linear colours as they are shown and as networks see them: exponent 1 / 2.2. From 0 to 1 for what a display can show,
// beyond that a tenth of the logarithm more, so that what is too bright still has a gradient.
at::Tensor display_values(const at::Tensor& linear);

// Mean over the object's pixels and channels, a row; of a row without object 0.
at::Tensor object_mean(const at::Tensor& values, const at::Tensor& mask);

// Linear images made brighter or darker, a row, so that the object's mean of log(value + 0.01) comes near that of the
// truth's.
at::Tensor exposed_as(const at::Tensor& images, const at::Tensor& truths, const at::Tensor& mask);

// The perceptual distance of images that are reduced to a side first, a row.
at::Tensor reduced_perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b,
                                       int side);

// 1 x 1 x h x 1: what a pixel of each row of a map counts on the sphere, 1 in the mean.
at::Tensor row_weights(std::int64_t rows);

// Maps of radiance reduced to fewer columns; energy is kept.
at::Tensor reduced_light(const at::Tensor& radiance, int columns);

}  // namespace partwise
