#include "partwise/imaging/netpbm.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

constexpr int most_pixels_a_side = 1 << 20;
constexpr int largest_code = 65535;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class NetpbmReader {
 public:
  NetpbmReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(file_, fmt::format("is not a whole PGM or PPM picture (byte {}: {})", at_, problem),
                     "give a binary one (P5, P6), or convert it to PNG");
  }

  int channels() {
    const bool grey = bytes_.starts_with("P5");
    if (!grey && !bytes_.starts_with("P6")) refuse("it begins neither with P5 nor with P6");
    at_ = 2;
    if (at_ < bytes_.size() && !is_space(bytes_[at_]) && bytes_[at_] != '#')
      refuse("no blank after the first two bytes");
    return grey ? 1 : 3;
  }

  // A number of the header, with the blanks and comments before it.
  int number(const char* what, int most) {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') at_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size() - 1);
      ++at_;
    }
    const std::string_view text = bytes_.substr(at_);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < 1 || value > most) {
      refuse(fmt::format("{} is not a number from 1 to {}", what, most));
    }
    at_ += static_cast<std::size_t>(end - text.data());
    return value;
  }

  // All that follows the one blank after the header.
  std::string_view rest() {
    if (at_ >= bytes_.size() || !is_space(bytes_[at_])) refuse("no blank after the header");
    return bytes_.substr(++at_);
  }

 private:
  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

Image decode_plain_netpbm(const std::string& file, std::string_view bytes) {
  NetpbmReader reader(file, bytes);
  const int channels = reader.channels();
  const int width = reader.number("the width", most_pixels_a_side);
  const int height = reader.number("the height", most_pixels_a_side);
  const int largest = reader.number("the largest code", largest_code);
  const std::string_view samples = reader.rest();
  const std::size_t size = largest > 255 ? 2 : 1;
  const std::uint64_t needed = std::uint64_t{size} * static_cast<std::uint64_t>(channels) *
                               static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (needed > samples.size()) {
    reader.refuse(fmt::format("{} x {} pixels need {} bytes, {} follow", width, height, needed, samples.size()));
  }
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    int code = 0;
    for (std::size_t k = 0; k < size; ++k) code = code << 8 | static_cast<unsigned char>(samples[i * size + k]);
    if (code > largest) reader.refuse(fmt::format("value {} is {}, above the largest, {}", i, code, largest));
    image.values[i] = static_cast<float>(code) / static_cast<float>(largest);
  }
  return image;
}

Image read_plain_netpbm(const std::filesystem::path& path) {
  return decode_plain_netpbm(path.string(), read_bytes(path));
}

Image read_netpbm(const std::filesystem::path& path) {
  Image image = read_plain_netpbm(path);
  for (float& value : image.values) value = linear_from_srgb(value);
  return image;
}

}  // namespace partwise
