#include "partwise/imaging/hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int shortest_row = 8, longest_row = 32767;  // that has runs by component
constexpr int longest_run = 127, longest_copy = 128;

Rgbe to_rgbe(const float* rgb) {
  constexpr float largest = 1.6e38f;  // 255 / 256 * 2^127 is the format's
  std::array<float, 3> value{};
  for (std::size_t k = 0; k < 3; ++k) value[k] = rgb[k] > 0 ? std::min(rgb[k], largest) : 0;  // NaN becomes 0
  const float peak = std::max({value[0], value[1], value[2]});
  if (peak < 1e-32f) return {};
  int exponent = 0;
  std::frexp(peak, &exponent);
  Rgbe code{0, 0, 0, static_cast<std::uint8_t>(exponent + 128)};
  for (std::size_t k = 0; k < 3; ++k) code[k] = static_cast<std::uint8_t>(std::ldexp(value[k], 8 - exponent));
  return code;
}

// The middle of what the code stands for, so that rounding down when writing leaves no bias.
void from_rgbe(const Rgbe& code, float scale, float* rgb) {
  const float unit = code[3] == 0 ? 0 : std::ldexp(scale, code[3] - 136);
  for (std::size_t k = 0; k < 3; ++k) rgb[k] = (static_cast<float>(code[k]) + 0.5f) * unit;
}

// The bytes of a file from the front; every refusal says where.
class HdrReader {
 public:
  HdrReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy = "give a whole Radiance file") const {
    throw InputError(file_, fmt::format("is not a whole Radiance picture (byte {}: {})", at_, problem), remedy);
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) refuse("the header does not end");
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  std::uint8_t byte() {
    if (at_ >= bytes_.size()) refuse("the file ends early");
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }

  std::size_t rest() const { return bytes_.size() - at_; }
  bool at_component_runs(int width) const {
    const auto peek = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes_[at_ + i]); };
    return width >= shortest_row && width <= longest_row && rest() >= 4 && peek(0) == 2 && peek(1) == 2 &&
           peek(2) * 256 + peek(3) == width;
  }

 private:
  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct HdrHeader {
  int width = 0, height = 0;
  float scale = 1;  // what undoes the exposures
};

int whole_number(std::string_view text, const HdrReader& reader) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1) reader.refuse("the size is not a number");
  return number;
}

// "-Y height +X width"
void read_size(std::string_view line, HdrHeader& header, const HdrReader& reader) {
  const std::size_t middle = line.find(" +X ");
  if (!line.starts_with("-Y ") || middle == std::string_view::npos) {
    reader.refuse("rows do not run from the top, left to right", "save it with -Y and +X");
  }
  header.height = whole_number(line.substr(3, middle - 3), reader);
  header.width = whole_number(line.substr(middle + 4), reader);
}

HdrHeader read_header(HdrReader& reader) {
  if (!reader.line().starts_with("#?")) reader.refuse("it does not begin with #?");
  HdrHeader header;
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      reader.refuse("the format is not 32-bit_rle_rgbe", "convert it to RGBE");
    }
    if (line.starts_with("EXPOSURE=")) {
      const std::string_view text = line.substr(9, 40);
      const float exposure = std::strtof(std::string(text).c_str(), nullptr);
      if (!(exposure > 1e-12f && exposure < 1e12f)) reader.refuse("the exposure is not a number above 0");
      header.scale /= exposure;
    }
  }
  if (!(header.scale > 1e-20f && header.scale < 1e20f)) reader.refuse("the exposures are out of range");
  read_size(reader.line(), header, reader);
  return header;
}

void read_component_runs(HdrReader& reader, std::vector<Rgbe>& row) {
  for (int k = 0; k < 4; ++k) reader.byte();  // 2, 2, the width: seen by at_component_runs
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < row.size();) {
      const int code = reader.byte();
      const bool is_run = code > longest_copy;
      const std::size_t count = static_cast<std::size_t>(is_run ? code - longest_copy : code);
      if (count == 0 || count > row.size() - x) reader.refuse("a run does not fit into its row");
      const std::uint8_t value = is_run ? reader.byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) row[x++][component] = is_run ? value : reader.byte();
    }
  }
}

// Plain pixels; 1, 1, 1, n repeats the last one n times, and several in a row are the digits of a longer repeat.
void read_pixel_runs(HdrReader& reader, std::vector<Rgbe>& row) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    Rgbe pixel{};
    for (std::uint8_t& value : pixel) value = reader.byte();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = pixel;
      shift = 0;
      continue;
    }
    if (x == 0 || shift > 16) reader.refuse("a run repeats nothing");
    const std::size_t count = std::size_t{pixel[3]} << shift;
    if (count > row.size() - x) reader.refuse("a run does not fit into its row");
    for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
    shift += 8;
  }
}

void append_runs(const std::vector<std::uint8_t>& values, std::string& bytes) {
  constexpr std::size_t worth_a_run = 4;
  const auto run_at = [&](std::size_t from) {
    std::size_t end = from;
    while (end < values.size() && end - from < longest_run && values[end] == values[from]) ++end;
    return end - from;
  };
  for (std::size_t at = 0; at < values.size();) {
    std::size_t run = run_at(at), end = at;
    while (end < values.size() && end - at < longest_copy && (run = run_at(end)) < worth_a_run) ++end;
    if (end > at) {
      bytes += static_cast<char>(end - at);
      bytes.append(values.begin() + static_cast<std::ptrdiff_t>(at), values.begin() + static_cast<std::ptrdiff_t>(end));
    }
    at = end;
    if (at < values.size() && run >= worth_a_run) {
      bytes += static_cast<char>(longest_copy + run);
      bytes += static_cast<char>(values[at]);
      at += run;
    }
  }
}

void append_row(const Image& image, int y, std::string& bytes) {
  std::array<std::vector<std::uint8_t>, 4> components;
  for (int x = 0; x < image.width; ++x) {
    const Rgbe code = to_rgbe(image.pixel(x, y));
    for (std::size_t k = 0; k < 4; ++k) components[k].push_back(code[k]);
  }
  if (image.width < shortest_row || image.width > longest_row) {
    for (std::size_t x = 0; x < components[0].size(); ++x) {
      for (const auto& component : components) bytes += static_cast<char>(component[x]);
    }
    return;
  }
  bytes += {2, 2, static_cast<char>(image.width >> 8), static_cast<char>(image.width & 255)};
  for (const auto& component : components) append_runs(component, bytes);
}

}  // namespace

std::string encode_hdr(const Image& image) {
  PARTWISE_CHECK(image.channels, ==, 3);
  std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  for (int y = 0; y < image.height; ++y) append_row(image, y, bytes);
  return bytes;
}

void write_hdr(const std::filesystem::path& path, const Image& image) { write_file(path, encode_hdr(image)); }

Image read_hdr(const std::filesystem::path& path) { return decode_hdr(path.string(), read_bytes(path)); }

Image decode_hdr(const std::string& file, std::string_view bytes) {
  HdrReader reader(file, bytes);
  const HdrHeader header = read_header(reader);
  // Runs by component give at most 127 values for 2 bytes; the older runs of pixels make rows of any length, so those
  // get an upper limit.
  constexpr std::uint64_t most_a_byte = 4096;
  const std::uint64_t pixels = static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
  if (pixels > most_a_byte * reader.rest()) {
    reader.refuse(
        fmt::format("{} x {} pixels are more than {} bytes can hold", header.width, header.height, reader.rest()));
  }
  Image image(header.width, header.height, 3);
  std::vector<Rgbe> row(static_cast<std::size_t>(header.width));
  for (int y = 0; y < header.height; ++y) {
    if (reader.at_component_runs(header.width)) {
      read_component_runs(reader, row);
    } else {
      read_pixel_runs(reader, row);
    }
    for (int x = 0; x < header.width; ++x) from_rgbe(row[static_cast<std::size_t>(x)], header.scale, image.pixel(x, y));
  }
  return image;
}

}  // namespace partwise
