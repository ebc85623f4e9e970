// The lobes of a Dsbrdf for eight half-vectors at a time, in single precision. Not installed.
#pragma once

#include <cmath>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/float8.h"

namespace partwise {

// log(n.h) from s = 1 - n.h, which keeps its digits near the mirror direction, where sharp lobes need them; and the
// same with the bound of the first lobe.
struct LogCosines {
  float8::Float8 first, others;

  explicit LogCosines(float8::Float8 s) {
    using namespace float8;
    const Float8 u = largest(1.0f - s, all(static_cast<float>(least_cosine)));
    others = log(u) + ((1.0f - u) - s);  // what 1 - s has lost is added again
    others = largest(others, all(static_cast<float>(std::log(least_cosine))));
    first = largest(others, all(static_cast<float>(std::log(least_cosine_first_lobe))));
  }
};

// One channel: the sum of its lobes, whose parameters are kappa(lobe) and gamma(lobe).
template <typename Kappa, typename Gamma>
float8::Float8 lobe_sum(const LogCosines& cosines, const Kappa& kappa, const Gamma& gamma) {
  using namespace float8;
  Float8 value{};
  for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
    const Float8 power = exp(gamma(lobe) * (lobe == 0 ? cosines.first : cosines.others));
    value += expm1(least(kappa(lobe) * power, all(static_cast<float>(largest_exponent))));
  }
  return value;
}

}  // namespace partwise
