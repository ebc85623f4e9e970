// How far a channel of the directional statistics model is from a measured one: what fits make small.
//
// The residual is the difference of log(f cos + 0.001) and counts robustly, as delta^2 (sqrt(1 + (r / delta)^2) - 1).
// Bins weigh w = 0.5 + 0.5 min(e / mean e, 30), where e is the light that they send on, f cos times the measure of the
// bin: uniform weights would not see highlights, those by e alone would see nothing else. A weak prior keeps curves
// smooth and, where the material says nothing, near their defaults, so that lobes keep their order.
#pragma once

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/material/half_angle_table.h"
#include "partwise/appearance/material/levenberg_marquardt.h"

namespace partwise {

// The weights of the bins of a channel with these values; 0 where nothing was measured.
HalfAngleArray loss_weights(const HalfAngleArray& values, const HalfAngleArray& cosine);

// Of all bins, of a residual.
inline constexpr double robust_delta = 1;

// Curves that a material without any evidence has.
DsbrdfChannel default_channel();

class DsbrdfLoss {
 public:
  DsbrdfLoss(const HalfAngleArray& values, const HalfAngleArray& cosine);

  NormalEquations operator()(const DsbrdfChannel& coefficients, bool derivatives) const;

 private:
  HalfAngleArray cosine_, target_, weights_;  // target: log(f cos + 0.001)
};

}  // namespace partwise
