// Pushing to the medial axis along a max-margin field (Liu 2017, Algorithm 4): the classifiers of one against the
// others name the two nearest obstacles s and t, the one between them gives f and its gradient, and
//
//   x <- x - f' d / |f'|^2    until |d| <= epsilon,
//
// with s and t named anew after each step. d is f itself (score); or what takes the robot to where the distances to
// s and t are equal, to first order, in the unit of f (clearance, section 5.4.1: distances decide when it is there); or
// the first for 30 % of the steps and the second afterwards (combined, section 5.4.2).
//
// Departures from what is printed: |d| is compared, and d is known before the loop starts. A step is at most a kernel's
// width long, beyond which f is not linear, and shrinks each time that s and t change. Where the gradient has vanished
// or points along the axis, clearance goes where the distances say. With clearance a push is done when the two nearest
// obstacles of all are equally far to `epsilon` times that distance; with score when |f| <= epsilon, which says nothing
// about distances.
#pragma once

#include <memory>

#include "partwise/motion/margin_field.h"
#include "partwise/motion/medial_axis.h"

namespace partwise {

enum class StepSize { score, clearance, combined };

struct MarginPushSettings {
  double epsilon = 0.02;
  StepSize step = StepSize::combined;
  int most_steps = 30;
};

class MarginPush final : public Retractor {
 public:
  // Which must outlive this.
  MarginPush(const Scene& scene, const MarginField& field, const MarginPushSettings& settings = {});

  Retraction operator()(const Configuration& q, Draw& draw) const override;

 private:
  struct Walk;
  void by_score(Walk& walk) const;
  void by_clearance(Walk& walk) const;
  bool look_around(Walk& walk, const AxisState& state) const;

  const Scene& scene_;
  const MarginField& field_;
  MarginPushSettings settings_;
};

// A push with a field of its own, trained here. `scene` must outlive it.
std::unique_ptr<Retractor> trained_push(const Scene& scene, const ContactSamples& contacts,
                                        const MarginFieldSettings& field = {}, const MarginPushSettings& push = {},
                                        const Progress& progress = {});

}  // namespace partwise
