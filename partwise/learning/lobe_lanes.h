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

// The lobes of one light pixel. evaluate() is false where no lane would notice the lobe.
template <typename Scalar>
class LobeLanes;

template <>
class LobeLanes<double> {
 public:
  explicit LobeLanes(const PixelLobes<double>& lobes) : lobes_(lobes) {}

  bool evaluate(std::size_t lobe, double log_cosine, LobeValue<double>& at) const {
    const double exponent = std::exp(lobes_.log_kappa[lobe] + lobes_.gamma[lobe] * log_cosine);
    at.value = std::expm1(std::min(exponent, largest_exponent));
    at.slope = exponent < largest_exponent ? exponent * (at.value + 1) : 0;
    return true;
  }

 private:
  const PixelLobes<double>& lobes_;
};

// In powers of 2: expm1(e) = 2^y - 1, y = e / ln 2, and y = 2^z, z = x / ln 2 - log2(ln 2).
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
    const Float8 y = exp2(largest(least(z, all(bound)), all(-100)));
    at.value = exp2m1(y);
    at.slope = z < bound ? log_2 * y * (at.value + 1) : Float8{};
    return true;
  }

 private:
  static constexpr float log_2 = 0.69314718f, over_log_2 = 1.44269504f, log2_over_log_2 = 0.52876637f;
  static constexpr float bound = 4.11372887f;  // log2(largest_exponent / ln 2)

  std::array<float, lobe_total> scale_, offset_;
};

}  // namespace partwise
