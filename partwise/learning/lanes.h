// The numbers that a kernel works on at a time: eight floats (appearance/rendering/float8.h), or one double where a
// test wants digits. A kernel that is written with these names serves both. Internal to this room.
#pragma once

#include <algorithm>
#include <cmath>

#include "partwise/appearance/rendering/float8.h"

namespace partwise::lanes {

template <typename Scalar>
struct Lanes;

template <>
struct Lanes<float> {
  using Value = float8::Float8;
  static constexpr int width = 8;
};

template <>
struct Lanes<double> {
  using Value = double;
  static constexpr int width = 1;
};

using float8::any_positive, float8::largest, float8::least, float8::sum;

inline bool any_positive(double value) { return value > 0; }
inline double least(double a, double b) { return std::min(a, b); }
inline double largest(double a, double b) { return std::max(a, b); }
inline double sum(double value) { return value; }

template <typename Scalar>
typename Lanes<Scalar>::Value load(const Scalar* from) {
  typename Lanes<Scalar>::Value value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}
template <typename Scalar>
void add_to(Scalar* target, const typename Lanes<Scalar>::Value& value) {
  const typename Lanes<Scalar>::Value total = load(target) + value;
  std::memcpy(target, &total, sizeof(total));
}

}  // namespace partwise::lanes
