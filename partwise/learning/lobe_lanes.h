// The lobes of a Dsbrdf and their derivatives, in the lanes of a kernel. Internal to this room.
#pragma once

#include <array>
#include <cmath>

#include "partwise/appearance/rendering/lobe_values.h"
#include "partwise/learning/lanes.h"
#include "partwise/learning/light_grid.h"

namespace partwise {

template <typename Value, typename Scalar>
Value dot(const std::array<Value, 3>& a, const std::array<Scalar, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Logarithms of n.h as the lobes take it, with their bounds, and the derivatives of these logarithms to n.h. Floats
// take 1 - n.h from the chord between the two, which keeps its digits where sharp lobes need them.
template <typename Scalar>
class HalfCosines {
 public:
  using Value = typename lanes::Lanes<Scalar>::Value;

  HalfCosines(const std::array<Value, 3>& normal, const std::array<Scalar, 3>& half) {
    if constexpr (std::is_same_v<Scalar, float>) {
      const std::array<Value, 3> chord{normal[0] - half[0], normal[1] - half[1], normal[2] - half[2]};
      const Value s = 0.5f * (chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
      const LogCosines cosines(s);
      cosine_ = 1.0f - s;
      first_ = cosines.first;
      others_ = cosines.others;
    } else {
      cosine_ = dot(normal, half);
      first_ = std::log(std::max(cosine_, least_cosine_first_lobe));
      others_ = std::log(std::max(cosine_, least_cosine));
    }
    inverse_ = Scalar(1) / cosine_;
  }

  const Value& log(int lobe) const { return lobe == 0 ? first_ : others_; }
  Value log_slope(int lobe) const {
    const auto bound = static_cast<Scalar>(lobe == 0 ? least_cosine_first_lobe : least_cosine);
    return cosine_ > bound ? inverse_ : Value{};
  }

 private:
  Value cosine_, inverse_, first_, others_;
};

// One lobe: expm1(exp(x)) with x = log(kappa) + gamma log(n.h), exp(x) no more than its bound.
template <typename Scalar>
class LobeLanes {
 public:
  using Value = typename lanes::Lanes<Scalar>::Value;

  bool seen;  // by any lane

  LobeLanes(const PixelLobes<Scalar>& lobes, int number, const Value& log_cosine) {
    const auto at = static_cast<std::size_t>(number);
    logarithm_ = lobes.gamma[at] * log_cosine + lobes.log_kappa[at];
    seen = lanes::any_positive(logarithm_ - lanes::Lanes<Scalar>::least_logarithm);
    if (seen) exponent_ = lanes::exp(lanes::least(logarithm_, Value{} + bound()));
  }

  Value value() const { return lanes::expm1(exponent_); }
  // To x, given the value.
  Value slope(const Value& value) const { return logarithm_ < bound() ? exponent_ * (value + 1) : Value{}; }

 private:
  static Scalar bound() { return static_cast<Scalar>(2.48490664978800031); }  // log(largest_exponent)

  Value logarithm_, exponent_;
};

}  // namespace partwise
