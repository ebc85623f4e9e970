// The header of a PLY file (Turk 1994): which elements follow, how many, and of which numbers each is made.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace partwise {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// Bytes of a number in the binary formats.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  // of each number
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // of a list's length
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  // The place of a property, or -1.
  int find(std::string_view property) const;
  // The fewest bytes that one takes in the file, all its lists being empty.
  std::size_t smallest_size(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // bytes to the first element
};

// Throws InputError at "file:line".
PlyHeader read_ply_header(const std::string& file, std::string_view bytes);

}  // namespace partwise
