#include "partwise/imaging/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

bool has_alpha(int channels) { return channels == 2 || channels == 4; }

// Whether value i of a row is a colour (which has a transfer curve) and not alpha (which has none).
bool is_colour(std::size_t i, int channels) {
  return !has_alpha(channels) || static_cast<int>(i % static_cast<std::size_t>(channels)) != channels - 1;
}

// 8 bits, or 16 with the high byte first.
std::vector<png_byte> samples_of(const Image& image, PngCodes codes) {
  std::vector<png_byte> samples;
  samples.reserve(image.values.size() * (codes == PngCodes::plain16 ? 2 : 1));
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const bool has_curve = codes == PngCodes::srgb && is_colour(i, image.channels);
    const float value = std::clamp(has_curve ? srgb_from_linear(image.values[i]) : image.values[i], 0.0f, 1.0f);
    const long code = std::lround((codes == PngCodes::plain16 ? 65535 : 255) * value);
    if (codes == PngCodes::plain16) samples.push_back(static_cast<png_byte>(code >> 8));
    samples.push_back(static_cast<png_byte>(code & 255));
  }
  return samples;
}

// libpng leaves a failing call by longjmp, which must not pass a frame that has something to destroy. So every use of
// libpng is a body without such locals, run by guarded(): all that it fills is owned further out.
void keep_message_and_jump(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

template <typename Body>
bool guarded(png_structp png, const Body& body) {
  if (setjmp(png_jmpbuf(png))) return false;
  body();
  return true;
}

struct Writer {
  std::string error;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, keep_message_and_jump, ignore_warning);
  png_infop info = png_create_info_struct(png);
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
  std::string error;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, keep_message_and_jump, ignore_warning);
  png_infop info = png_create_info_struct(png);
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void take(png_structp png, png_bytep data, std::size_t size) {
  auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (size > rest.size()) png_error(png, "the file ends early");
  std::copy_n(rest.data(), size, reinterpret_cast<char*>(data));
  rest.remove_prefix(size);
}

std::uint32_t big_endian(std::string_view four) {
  std::uint32_t value = 0;
  for (const char c : four) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

InputError not_whole(const std::string& file, const std::string& why) {
  return {file, fmt::format("is not a whole PNG file ({})", why), "give a file that an image viewer opens"};
}

// libpng sets aside what a chunk announces before it reads any of it: gigabytes, where a length is damaged.
void check_chunks(const std::string& file, std::string_view bytes) {
  constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
  if (bytes.size() < signature || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, signature)) return;
  std::string_view rest = bytes.substr(signature);
  while (rest.size() >= length_and_type) {
    const std::uint32_t length = big_endian(rest.substr(0, 4));
    if (rest.size() - length_and_type < length + checksum) {
      throw not_whole(file, fmt::format("a chunk announces {} bytes, more than follow", length));
    }
    if (rest.substr(4, 4) == "IEND") return;
    rest.remove_prefix(length_and_type + length + checksum);
  }
}

// A header may announce a million pixels a side, whatever follows. What was deflated grows 1032-fold at most.
void check_size(const std::string& file, png_structp png, png_infop info, std::size_t bytes) {
  const std::size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  if (png_get_rowbytes(png, info) * height > 1032 * bytes) {
    throw InputError(file,
                     fmt::format("announces {} x {} pixels, more than its {} bytes can hold", width, height, bytes),
                     "give a file that an image viewer opens");
  }
}

}  // namespace

std::string encode_png(const Image& image, PngCodes codes) {
  constexpr std::array<int, 4> colour_types{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                            PNG_COLOR_TYPE_RGB_ALPHA};
  PARTWISE_CHECK(image.channels, >=, 1);
  PARTWISE_CHECK(image.channels, <=, 4);
  const int colour_type = colour_types[static_cast<std::size_t>(image.channels - 1)];
  const std::vector<png_byte> samples = samples_of(image, codes);
  const std::size_t row_size = samples.size() / static_cast<std::size_t>(image.height);

  std::string bytes;
  Writer writer;
  const bool written = guarded(writer.png, [&] {
    png_set_write_fn(writer.png, &bytes, append, nullptr);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                 codes == PngCodes::plain16 ? 16 : 8, colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (codes == PngCodes::srgb) png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer.png, writer.info);
    for (std::size_t row = 0; row < samples.size(); row += row_size) png_write_row(writer.png, samples.data() + row);
    png_write_end(writer.png, writer.info);
  });
  PARTWISE_CHECK(written ? "" : writer.error, ==, std::string());
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image, PngCodes codes) {
  write_file(path, encode_png(image, codes));
}

Image read_png(const std::filesystem::path& path) { return decode_png(path.string(), read_bytes(path)); }

Image decode_plain_png(const std::string& file, std::string_view bytes) {
  check_chunks(file, bytes);
  Reader reader;
  Image image;
  std::string_view rest = bytes;
  std::vector<png_byte> samples;  // 16 bits a value, big endian
  std::vector<png_bytep> rows;
  bool read = guarded(reader.png, [&] {
    png_set_read_fn(reader.png, &rest, take);
    png_read_info(reader.png, reader.info);
  });
  if (read) check_size(file, reader.png, reader.info, bytes.size());
  read = read && guarded(reader.png, [&] {
           png_set_expand_16(reader.png);  // palettes, few bits and colour keys become plain channels as well
           png_set_interlace_handling(reader.png);
           png_read_update_info(reader.png, reader.info);
         });
  if (read) {
    image = Image(static_cast<int>(png_get_image_width(reader.png, reader.info)),
                  static_cast<int>(png_get_image_height(reader.png, reader.info)),
                  png_get_channels(reader.png, reader.info));
    const std::size_t row_size = png_get_rowbytes(reader.png, reader.info);
    samples.resize(row_size * static_cast<std::size_t>(image.height));
    for (std::size_t row = 0; row < samples.size(); row += row_size) rows.push_back(samples.data() + row);
    read = guarded(reader.png, [&] {
      png_read_image(reader.png, rows.data());
      png_read_end(reader.png, nullptr);
    });
  }
  if (!read) throw not_whole(file, reader.error);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    image.values[i] = static_cast<float>(samples[2 * i] * 256 + samples[2 * i + 1]) / 65535;
  }
  return image;
}

Image read_plain_png(const std::filesystem::path& path) { return decode_plain_png(path.string(), read_bytes(path)); }

Image decode_png(const std::string& file, std::string_view bytes) {
  Image image = decode_plain_png(file, bytes);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (is_colour(i, image.channels)) image.values[i] = linear_from_srgb(image.values[i]);
  }
  return image;
}

}  // namespace partwise
