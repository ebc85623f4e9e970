#include "partwise/appearance/rendering/float8.h"

#include <gtest/gtest.h>

#include <cmath>

namespace partwise::float8 {
namespace {

template <typename Vector, typename True>
void expect_close(const Vector& approximation, const True& truth, float from, float to, bool logarithmic,
                  double bound) {
  constexpr int steps = 200000;
  for (int i = 0; i <= steps; ++i) {
    const float part = static_cast<float>(i) / steps;
    const float x = logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part;
    const double expected = truth(static_cast<double>(x));
    ASSERT_NEAR(static_cast<double>(approximation(all(x))[i % 8]), expected, bound * std::abs(expected)) << x;
  }
}

TEST(Float8, ExponentialsMeetTheLibrarysToThreePartsInTenMillion) {
  expect_close([](Float8 x) { return exp(x); }, [](double x) { return std::exp(x); }, -79, 79, false, 3e-7);
  expect_close([](Float8 x) { return expm1(x); }, [](double x) { return std::expm1(x); }, 1e-20f, 79, true, 3e-7);
  expect_close([](Float8 x) { return expm1(-x); }, [](double x) { return std::expm1(-x); }, 1e-20f, 79, true, 3e-7);
}

TEST(Float8, PowersOfTwoMeetTheLibrarysToFourPartsInTenMillion) {
  expect_close([](Float8 x) { return exp2(x); }, [](double x) { return std::exp2(x); }, -119, 119, false, 4e-7);
  const auto minus_one = [](double x) { return std::expm1(x * std::log(2.0)); };
  expect_close([](Float8 x) { return exp2m1(x); }, minus_one, 1e-20f, 119, true, 4e-7);
  EXPECT_EQ(exp2m1(all(0))[2], 0);
}

TEST(Float8, LogarithmsMeetTheLibrarysToThreePartsInTenMillion) {
  expect_close([](Float8 x) { return log(x); }, [](double x) { return std::log(x); }, 1e-30f, 0.999f, true, 3e-7);
  expect_close([](Float8 x) { return log(x); }, [](double x) { return std::log(x); }, 1.001f, 1e30f, true, 3e-7);
  EXPECT_EQ(log(all(1))[3], 0);
}

TEST(Float8, AsksAndAddsOverAllLanes) {
  Float8 value = all(-1);
  EXPECT_FALSE(any_positive(value));
  EXPECT_FALSE(any_positive(all(0)));
  value[5] = 3;
  EXPECT_TRUE(any_positive(value));
  EXPECT_EQ(sum(value), -4);
  EXPECT_EQ(least(value, all(0))[5], 0);
  EXPECT_EQ(largest(value, all(0))[5], 3);
  EXPECT_EQ(to_int(value * 0.9f)[5], 2);
  EXPECT_EQ(multiply_add(value, all(4), all(1))[5], 13);
}

}  // namespace
}  // namespace partwise::float8
