// Numbers from and to the bytes of binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace partwise {

// A number stored at `bytes` in the given order.
template <typename T>
T load(const char* bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(own.begin(), own.end());
  return std::bit_cast<T>(own);
}

// Appends a number, little endian.
template <typename T>
void store(std::string& bytes, T value) {
  auto own = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native != std::endian::little) std::reverse(own.begin(), own.end());
  bytes.append(own.data(), own.size());
}

}  // namespace partwise
