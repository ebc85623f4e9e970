// The lobes of a Dsbrdf and their derivatives, in the lanes of a kernel. Internal to this room.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

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

// A lobe at some normals: expm1(exp(x)) with x = log(kappa) + gamma log(n.h), exp(x) no more than its bound; and the
// derivative to x, zero where the bound holds.
template <typename Value>
struct LobeValue {
  Value value, slope;
};

// Of x, in either kind of lanes. Floats go by powers of 2: expm1(e) = 2^y - 1, y = e / ln 2, and y = 2^z with
// z = x / ln 2 - log2(ln 2), which lobe_of_power takes.
inline LobeValue<double> lobe_value(double x) {
  const double exponent = std::exp(x), value = std::expm1(std::min(exponent, largest_exponent));
  return {value, exponent < largest_exponent ? exponent * (value + 1) : 0};
}

inline constexpr float over_log_2 = 1.44269504f, log2_over_log_2 = 0.52876637f;

inline LobeValue<float8::Float8> lobe_of_power(const float8::Float8& z) {
  using namespace float8;
  constexpr float log_2 = 0.69314718f, bound = 4.11372887f;  // log2(largest_exponent / ln 2)
  const Float8 y = exp2(largest(least(z, all(bound)), all(-100))), value = exp2m1(y);
  return {value, z < bound ? log_2 * y * (value + 1) : Float8{}};
}
inline LobeValue<float8::Float8> lobe_value(const float8::Float8& x) {
  return lobe_of_power(float8::multiply_add(x, float8::all(over_log_2), float8::all(log2_over_log_2)));
}

// The lobes of one light pixel, the same in all lanes. evaluate() is false where no lane would notice the lobe.
template <typename Scalar>
class LobeLanes;

template <>
class LobeLanes<double> {
 public:
  explicit LobeLanes(const PixelLobes<double>& lobes) : lobes_(lobes) {}

  bool evaluate(std::size_t lobe, double log_cosine, LobeValue<double>& at) const {
    at = lobe_value(lobes_.log_kappa[lobe] + lobes_.gamma[lobe] * log_cosine);
    return true;
  }

 private:
  const PixelLobes<double>& lobes_;
};

template <>
class LobeLanes<float> {
 public:
  explicit LobeLanes(const PixelLobes<float>& lobes) {
    for (std::size_t lobe = 0; lobe < lobe_total; ++lobe) {
      scale_[lobe] = lobes.gamma[lobe] * over_log_2;
      offset_[lobe] = lobes.log_kappa[lobe] * over_log_2 + log2_over_log_2;
    }
  }

  bool evaluate(std::size_t lobe, const float8::Float8& log_cosine, LobeValue<float8::Float8>& at) const {
    using namespace float8;
    constexpr float least_seen = -45;  // 2^-45 is nothing beside what materials reflect
    const Float8 z = multiply_add(log_cosine, all(scale_[lobe]), all(offset_[lobe]));
    if (!any_positive(z - least_seen)) return false;
    at = lobe_of_power(z);
    return true;
  }

 private:
  std::array<float, lobe_total> scale_, offset_;
};

}  // namespace partwise
