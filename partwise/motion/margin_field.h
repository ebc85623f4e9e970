// The field that leads to the medial axis of the free space between obstacles (Liu 2017, section 5.3): classifiers of
// one obstacle against the others tell which two obstacles are nearest, those of one against one lead to where their
// distances are equal.
//
// Of n obstacles, n (n - 1) / 2 classifiers over all samples would not do. So each learns from what matters to it. Many
// points of the space, and the midpoints between each sample and the nearest one of another obstacle, are asked for
// their two nearest obstacles by samples. Obstacles that are the two of any point are neighbours; the distances to
// both, added, are in the median their gap; the farthest such point is an obstacle's reach.
//
//   one against the others  the obstacle's samples against those of its neighbours, at most `most_others` of them, the
//                           nearest; a kernel `reach_width` times the reach wide, so that it is still felt there;
//                           evaluated only within the reach
//   one against one         the samples of the two, a kernel `gap_width` gaps wide. Neighbours are trained at once,
//                           others when they are first asked for
//
// All is const after construction (what is trained late is trained once, whoever asks first) and the same for any
// number of threads. Errors: InputError for fewer than two obstacles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "partwise/base/progress.h"
#include "partwise/motion/margin_classifier.h"

namespace partwise {

struct MarginFieldSettings {
  double gap_width = 1.5, reach_width = 0.5;
  double cost = 10;      // of a sample on the wrong side
  double density = 0.5;  // of samples (contact_samples.h); 0: all
  int most_others = 1500;
  std::uint64_t seed = 0;
};

class MarginField {
 public:
  MarginField(const ConfigurationSpace& space, const ContactSamples& samples, const MarginFieldSettings& settings = {},
              const Progress& progress = {});
  ~MarginField();

  int obstacles() const;
  const ContactSamples& samples() const;  // those that were kept

  // The nearest two obstacles as the field sees them, the nearer one first. x is embedded.
  std::array<int, 2> nearest_two(const MotionVector& x) const;
  // Above 0 nearer to `obstacle` than to its neighbours.
  const MarginClassifier& against_others(int obstacle) const;
  // Above 0 nearer to the lower of the two numbers.
  const MarginClassifier& between(int a, int b) const;

  struct Size {
    int pairs = 0, supports = 0;  // of one against one
    int supports_against_others = 0;
  };
  Size size() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace partwise
