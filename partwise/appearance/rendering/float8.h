// Eight floats at a time: arithmetic by the compiler's vector extension, and the few functions that reflection needs.
//
// Powers of 2 as kernels that are nothing but lobes want them, with few operations: 2^x for x in [-120, 120] and 2^x -
// 1 for x in [0, 120], both within 4e-7 relatively. exp and log by reduction to a short interval and a polynomial,
// within 3e-7 of the true value relatively (expm1 too, also near 0); the same bits on every machine with the same
// instructions. Loads and stores take any alignment.
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace partwise::float8 {

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));

inline Float8 load(const float* from) {
  Float8 value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}
inline void store(float* to, Float8 value) { std::memcpy(to, &value, sizeof(value)); }
inline Float8 all(float value) { return Float8{} + value; }

inline Int8 bits(Float8 value) { return reinterpret_cast<Int8>(value); }
inline Float8 from_bits(Int8 value) { return reinterpret_cast<Float8>(value); }
inline Float8 to_float(Int8 value) { return __builtin_convertvector(value, Float8); }
inline Int8 to_int(Float8 value) { return __builtin_convertvector(value, Int8); }  // towards zero

inline Float8 least(Float8 a, Float8 b) { return a < b ? a : b; }
inline Float8 largest(Float8 a, Float8 b) { return a > b ? a : b; }
inline bool any_positive(Float8 value) {
  const Int8 positive = value > 0;
#ifdef __AVX__
  return _mm256_movemask_ps(reinterpret_cast<__m256>(positive)) != 0;
#else
  std::int64_t words[4], any = 0;
  std::memcpy(words, &positive, sizeof(words));
  for (const std::int64_t word : words) any |= word;
  return any != 0;
#endif
}
// a * b + c, rounded once where there is an instruction for it.
inline Float8 multiply_add(Float8 a, Float8 b, Float8 c) {
#ifdef __FMA__
  return _mm256_fmadd_ps(a, b, c);
#else
  return a * b + c;
#endif
}
inline float sum(Float8 value) {  // in one order
  return ((value[0] + value[4]) + (value[2] + value[6])) + ((value[1] + value[5]) + (value[3] + value[7]));
}

// x = k ln 2 + r with |r| <= ln 2 / 2: 2^k and exp(r) - 1. For x in [-80, 80].
struct Exponential {
  Float8 power, rest;

  explicit Exponential(Float8 x) {
    constexpr float magic = 12582912.0f;  // 1.5 * 2^23: adding it rounds to a whole number
    const Float8 k = (x * 1.44269504089f + magic) - magic;
    const Float8 r = (x - k * 0.693359375f) + k * 2.12194440e-4f;  // ln 2 in two parts, the first exact times k
    Float8 p = all(1.9841270e-4f);                                 // Taylor: 1/7!, 1/6!, ... 1/2!
    p = p * r + 1.3888889e-3f;
    p = p * r + 8.3333333e-3f;
    p = p * r + 4.1666667e-2f;
    p = p * r + 1.6666667e-1f;
    p = p * r + 0.5f;
    rest = p * (r * r) + r;
    power = from_bits((to_int(k) + 127) << 23);
  }
};

// exp(x) - 1 for x in [-80, 80].
inline Float8 expm1(Float8 x) {
  const Exponential e(x);
  return e.power * e.rest + (e.power - 1.0f);
}

// Beyond +-80 the value there.
inline Float8 exp(Float8 x) {
  const Exponential e(largest(least(x, all(80)), all(-80)));
  return e.power * e.rest + e.power;
}

// x = k + f with |f| <= 1/2; t holds k in its lowest bits, which a shift makes the exponent of 2^k. And (2^f - 1) / f.
struct PowerOfTwo {
  Float8 t, f, rate;

  explicit PowerOfTwo(Float8 x) {
    constexpr float magic = 12582912.0f;
    t = x + magic;
    f = x - (t - magic);
    Float8 p = all(1.54531629e-04f);  // through (2^f - 1) / f at the Chebyshev nodes
    p = multiply_add(p, f, all(1.33908634e-03f));
    p = multiply_add(p, f, all(9.61808256e-03f));
    p = multiply_add(p, f, all(5.55035711e-02f));
    p = multiply_add(p, f, all(2.40226508e-01f));
    rate = multiply_add(p, f, all(6.93147188e-01f));
  }
};

inline Float8 exp2(Float8 x) {
  const PowerOfTwo power(x);
  return from_bits(bits(multiply_add(power.rate, power.f, all(1))) + (bits(power.t) << 23));
}

inline Float8 exp2m1(Float8 x) {
  const PowerOfTwo power(x);
  const Float8 whole = from_bits(bits(all(1)) + (bits(power.t) << 23));
  return multiply_add(whole, power.rate * power.f, whole - 1.0f);
}

// Natural logarithm for x in the range of normal floats. With x = 2^k m, m in [0.707, 1.414): k ln 2 + log(m), the
// latter by atanh of t = (m - 1) / (m + 1), |t| <= 0.1716.
inline Float8 log(Float8 x) {
  const Int8 k = (bits(x) - 0x3f3504f3) >> 23;
  const Float8 m = from_bits(bits(x) - (k << 23)), e = to_float(k);
  const Float8 t = (m - 1.0f) / (m + 1.0f), t2 = t * t;
  Float8 p = all(2.0f / 9);
  p = p * t2 + 2.0f / 7;
  p = p * t2 + 2.0f / 5;
  p = p * t2 + 2.0f / 3;
  p = p * (t2 * t) + 2.0f * t;
  return (p + e * -2.12194440e-4f) + e * 0.693359375f;
}

}  // namespace partwise::float8
