// Contact samples by nearness (nanoflann): of which obstacle is the nearest one, and how far is the nearest of another.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "partwise/motion/contact_samples.h"

namespace partwise {

class SampleTree {
 public:
  explicit SampleTree(const ContactSamples& samples);  // which must outlive this
  ~SampleTree();

  // The two obstacles with the nearest samples, and those samples' distances; the second has number -1 if there is
  // none.
  struct Pair {
    int nearest = -1, second = -1;
    double distance = 0, second_distance = 0;
  };
  Pair nearest_two(const MotionVector& x) const;
  // The nearest sample that is not of `obstacle`; -1 and infinite if there is none.
  struct Sample {
    Eigen::Index sample = -1;
    double distance = 0;
  };
  Sample nearest_other(const MotionVector& x, int obstacle) const;

 private:
  struct Index;
  const ContactSamples& samples_;
  std::unique_ptr<Index> index_;
};

}  // namespace partwise
