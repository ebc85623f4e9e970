// Random numbers that are functions of what they are for: of a seed, of the number of a thing, and of a purpose. The
// same for whoever asks, whenever; what is drawn for one thing does not depend on what was drawn before.
//
// Errors: none.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "partwise/base/splitmix.h"

namespace partwise {

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t number, std::uint64_t purpose)
      : state_(splitmix(splitmix(splitmix(seed + splitmix_step) + number) + purpose * splitmix_step)) {}

  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // in [0, 1)
  double within(double least, double most) { return least + (most - least) * unit(); }
  int below(int count) { return static_cast<int>(unit() * count); }

  // `count` different numbers below `all`, in the order drawn (Fisher, Yates).
  std::vector<int> different(int count, int all) {
    std::vector<int> numbers(static_cast<std::size_t>(all));
    std::iota(numbers.begin(), numbers.end(), 0);
    for (int i = 0; i < count; ++i) std::swap(numbers[i], numbers[i + below(all - i)]);
    numbers.resize(static_cast<std::size_t>(count));
    return numbers;
  }

 private:
  std::uint64_t next() { return splitmix(state_ += splitmix_step); }
  std::uint64_t state_;
};

}  // namespace partwise
