// A support vector machine with a radial kernel, by libsvm (Chang, Lin 2011):
//
//   f(x) = sum a_i exp(-|x - x_i|^2 / (2 width^2)) + b
//
// f is about 1 and -1 at the samples of the two classes that matter, and 0 half way between them, which is what makes
// it a field for the medial axis (Liu 2017, section 5.3). Points are embedded (configuration_space.h).
#pragma once

#include <vector>

#include "partwise/motion/contact_samples.h"

namespace partwise {

struct MarginSettings {
  double width = 1;  // of the kernel, in the unit of the points
  double cost = 10;  //  of a sample on the wrong side
};

struct FieldValue {
  double value = 0;
  MotionVector gradient;
};

class MarginClassifier {
 public:
  // The first rows are above 0, `positive` of them, the others below. Both must be there.
  MarginClassifier(const MotionPoints& points, Eigen::Index positive, const MarginSettings& settings);

  double value(const MotionVector& x) const;
  FieldValue at(const MotionVector& x) const;

  int supports() const { return supports_; }
  double width() const { return width_; }

 private:
  static constexpr Eigen::Index lane = 16;

  int supports_ = 0;
  double width_ = 1, offset_ = 0;
  // A column a coordinate, filled up to whole lanes with weights of 0.
  Eigen::ArrayXXd points_;
  Eigen::ArrayXd weights_;
};

}  // namespace partwise
