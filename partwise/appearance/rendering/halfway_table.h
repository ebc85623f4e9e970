// A material that depends on the half-vector's angles alone, tabulated so that a renderer can ask for it millions of
// times: f(n.h, theta_d) in linear RGB. Internal to this room.
//
// Rows are evenly spaced in theta_d, and linear between: in the middle of two rows the shipped materials are 0.04 % off
// in the mean and 0.3 % at worst (medians of the hundred, up to 85 degrees). Along a row the knots lie densely towards
// n.h = 1, where lobes are sharp, and towards 0, where cloth shines: with s = 1 - n.h and m = min(s, n.h), they are the
// values of m + 2^-18 that have five bits of mantissa. So the bits of a float are its place among the knots, and no
// logarithm is needed; between knots the table is linear.
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/float8.h"

namespace partwise {

class HalfwayTable {
 public:
  static constexpr int mantissa_bits = 5;
  static constexpr float offset = 1.0f / (1 << 18);
  static constexpr int half = (17 << mantissa_bits) + 1;  // places of m in [0, 1/2]; the last one is shared
  static constexpr int places = 2 * half - 1;
  static constexpr int rows = 129;

  // One row, four floats a place: R, G, B and zero. One place more than there are, so that the last has a next one.
  using Row = std::array<float, 4 * (places + 1)>;

  explicit HalfwayTable(const Dsbrdf& material);

  // The row at theta_d, each channel times `factor`.
  void row(double theta_d, const Eigen::Vector3f& factor, Row& result) const;

  // At one theta_d, by its cosine, and one s = 1 - n.h, in [0, 1].
  Eigen::Vector3f value(float cos_theta_d, float s) const;

  // Where s = 1 - n.h, in [0, 1], lies in a row: whole part and fraction.
  static float8::Float8 place(float8::Float8 s) {
    using namespace float8;
    constexpr float unit = 1.0f / (1 << (23 - mantissa_bits));
    const Float8 other = 1.0f - s;
    const Float8 near = unit * to_float(bits(largest(least(s, other), all(0)) + offset) - first_bits());
    return s < other ? near : static_cast<float>(places - 1) - near;
  }

  static float place(float s) { return place(float8::all(s))[0]; }

  // 1 - n.h of a whole place.
  static float knot(int place);

 private:
  static float8::Int8 first_bits() { return float8::bits(float8::all(offset)); }

  std::unique_ptr<Row[]> table_;
};

}  // namespace partwise
