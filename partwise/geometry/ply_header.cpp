#include "partwise/geometry/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

PlyType to_type(const TextScanner& scanner, std::string_view name) {
  using enum PlyType;
  // Both the names of 1994 and those with the number of bits are in use.
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", int8},
                                                                                {"uchar", uint8},
                                                                                {"short", int16},
                                                                                {"ushort", uint16},
                                                                                {"int", int32},
                                                                                {"uint", uint32},
                                                                                {"float", float32},
                                                                                {"double", float64},
                                                                                {"int8", int8},
                                                                                {"uint8", uint8},
                                                                                {"int16", int16},
                                                                                {"uint16", uint16},
                                                                                {"int32", int32},
                                                                                {"uint32", uint32},
                                                                                {"float32", float32},
                                                                                {"float64", float64}}};
  for (const auto& [known, type] : kTypes)
    if (name == known) return type;
  scanner.fail(fmt::format("{} is not a type of PLY", shown(name)), "correct the header");
}

PlyFormat to_format(const TextScanner& scanner, std::string_view name) {
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (name == "binary_big_endian") return PlyFormat::binary_big_endian;
  scanner.fail(fmt::format("{} is not a format of PLY", shown(name)), "correct the header");
}

PlyProperty read_property(TextScanner& scanner) {
  PlyProperty property;
  std::string_view type = scanner.token_in_line();
  property.is_list = type == "list";
  if (property.is_list) {
    property.count_type = to_type(scanner, scanner.token_in_line());
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64) {
      scanner.fail("a list is counted by a floating-point number", "correct the header");
    }
    type = scanner.token_in_line();
  }
  property.type = to_type(scanner, type);
  property.name = scanner.token_in_line();
  if (property.name.empty()) scanner.fail("a property has no name", "correct the header");
  return property;
}

PlyElement read_element(TextScanner& scanner) {
  PlyElement element;
  element.name = scanner.token_in_line();
  const std::int64_t count = scanner.to_integer(scanner.token_in_line(), "the number of elements");
  if (count < 0) scanner.fail(fmt::format("{} elements are announced", count), "correct the header");
  element.count = static_cast<std::size_t>(count);
  return element;
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

std::size_t PlyElement::smallest_size(PlyFormat format) const {
  if (format == PlyFormat::ascii) return 2 * properties.size();  // a digit and a blank each
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    size += size_of(property.is_list ? property.count_type : property.type);
  return size;
}

PlyHeader read_ply_header(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes);
  PlyHeader header;
  const std::string_view magic = scanner.token_in_line();
  if (magic != "ply") {
    scanner.fail(fmt::format("begins with {} instead of ply", shown(magic)),
                 "give a PLY file, or use the ending of its true format");
  }
  scanner.skip_line();
  bool has_format = false;
  for (;;) {
    const std::string_view keyword = scanner.token();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.format = to_format(scanner, scanner.token_in_line());
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (keyword == "property") {
      if (header.elements.empty()) scanner.fail("a property stands before the first element", "correct the header");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (keyword.empty()) {
      scanner.fail("the header does not end", "the file was cut short: export it again");
    } else if (keyword != "comment" && keyword != "obj_info") {
      scanner.fail(fmt::format("{} is not a word of a PLY header", shown(keyword)), "correct the header");
    }
    scanner.skip_line();
  }
  if (!has_format) scanner.fail("the header names no format", "add a line such as 'format ascii 1.0'");
  scanner.skip_line();  // One line feed, with or without a carriage return before it; then come the elements.
  header.size = scanner.position();
  return header;
}

}  // namespace partwise
