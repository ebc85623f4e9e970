// How far normals are from the true ones, by the field's protocol (Fouhey, Gupta, Hebert 2013; Eigen and Fergus 2015;
// Bae and Davison 2024): pixels of all images pooled, the angle of each the arc cosine of the clamped dot product.
//
// A pixel counts where there is a true normal (finite, not zero) and, if a mask is given, where it is above half.
// Lengths do not matter. Where the normal that is judged is zero or not finite the angle is 90 degrees and the cosine
// 0. Angles in degrees; shares are of angles below a limit. Everything is exact to rounding but for the median, which
// is exact to 0.001 degrees: so the memory is 1.4 MB, whatever the number of pixels. Sums depend in their last bits on
// the order of images, not on threads. Errors: CheckFailed for images of different sizes or not of 3 channels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "partwise/imaging/image.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {

inline constexpr std::array<double, 5> normal_error_limits{5, 7.5, 11.25, 22.5, 30};  // degrees

struct NormalErrors {
  std::uint64_t pixels = 0;             // all else is 0 where there are none
  double mean = 0;                      // degrees
  double median = 0;                    // degrees; of an even number, the mean of the middle two
  double rmse = 0;                      // degrees
  std::array<double, 5> share_below{};  // of normal_error_limits
  double cosine = 0;                    // mean (Liu 2017, Table 4.1)
};

class NormalMeasure {
 public:
  NormalMeasure();

  // Pools the pixels of one more image.
  void add(const Image& normals, const Image& truth);
  void add(const Image& normals, const Image& truth, const Mask& mask);
  // Pools all that another has.
  void add(const NormalMeasure& other);

  NormalErrors errors() const;

 private:
  void add(const Image& normals, const Image& truth, const Mask* mask);
  double rank(std::uint64_t number) const;  // the angle of that number among all, ascending, from 0

  std::uint64_t pixels_ = 0;
  double angles_ = 0, squares_ = 0, cosines_ = 0;
  std::array<std::uint64_t, 5> below_{};
  std::vector<std::uint64_t> counts_;  // of angles, in steps of 0.001 degrees
};

}  // namespace partwise
