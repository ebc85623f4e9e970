// The finaliser of splitmix64 (Steele, Lea, Flood 2014): 64 bits to 64 bits, each of which depends on all. For hashing,
// and for random numbers that are functions of what they are for.
#pragma once

#include <cstdint>

namespace partwise {

inline std::uint64_t splitmix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

inline constexpr std::uint64_t splitmix_step = 0x9E3779B97F4A7C15u;  // from one number of a sequence to the next

}  // namespace partwise
