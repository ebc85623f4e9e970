#include "partwise/imaging/jpeg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>  // jpeglib.h needs it
#include <optional>
#include <vector>

#include <jpeglib.h>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

constexpr std::size_t most_pixels_a_byte = 4000;  // of one plain colour, progressive
constexpr const char* remedy = "give a file that an image viewer opens";

// libjpeg reports by callbacks; a warning means that it has made something up.
struct Reader {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  Reader() {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
    errors.error_exit = [](j_common_ptr info) { fail(info); };
    errors.emit_message = [](j_common_ptr info, int level) {
      if (level < 0) fail(info);
    };
    jpeg_create_decompress(&jpeg);
  }
  ~Reader() { jpeg_destroy_decompress(&jpeg); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[noreturn]] static void fail(j_common_ptr info) {
    auto& reader = *static_cast<Reader*>(info->client_data);
    info->err->format_message(info, reader.message.data());
    std::longjmp(reader.failed, 1);
  }

  // No object with a destructor may be made between here and a longjmp: `pixels` is the caller's.
  bool read_header(std::string_view bytes) {
    if (setjmp(failed) != 0) return false;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&jpeg, JPEG_APP0 + 1, 0xFFFF);
    jpeg_read_header(&jpeg, TRUE);
    return true;
  }
  bool read_pixels(std::vector<unsigned char>& pixels) {
    if (setjmp(failed) != 0) return false;
    jpeg_start_decompress(&jpeg);
    const std::size_t row =
        static_cast<std::size_t>(jpeg.output_width) * static_cast<std::size_t>(jpeg.output_components);
    while (jpeg.output_scanline < jpeg.output_height) {
      JSAMPROW line = pixels.data() + row * jpeg.output_scanline;
      jpeg_read_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
  }
};

// Bytes of TIFF, in one of two orders. Nothing beyond the end.
class Tiff {
 public:
  Tiff(const unsigned char* bytes, std::size_t size) : bytes_(bytes), size_(size), big_(size > 0 && bytes[0] == 'M') {}

  std::optional<std::uint32_t> number(std::size_t at, std::size_t width) const {
    if (at > size_ || size_ - at < width) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width; ++i) value = value << 8 | bytes_[at + (big_ ? i : width - 1 - i)];
    return value;
  }

 private:
  const unsigned char* bytes_;
  std::size_t size_;
  bool big_;
};

// EXIF's orientation, 1 to 8; 1, upright, where there is none.
int orientation(const jpeg_decompress_struct& jpeg) {
  constexpr std::string_view name("Exif\0\0", 6);
  for (auto* marker = jpeg.marker_list; marker != nullptr; marker = marker->next) {
    if (marker->data_length < name.size() || !std::equal(name.begin(), name.end(), marker->data)) continue;
    const Tiff tiff(marker->data + name.size(), marker->data_length - name.size());
    const auto directory = tiff.number(4, 4);
    const auto entries = directory ? tiff.number(*directory, 2) : std::nullopt;
    for (std::uint32_t i = 0; entries && i < *entries; ++i) {
      const std::size_t entry = *directory + 2 + 12 * std::size_t{i};
      constexpr std::uint32_t orientation_tag = 0x0112;
      if (tiff.number(entry, 2) != orientation_tag) continue;
      const auto value = tiff.number(entry + 8, 2);
      return value && *value >= 1 && *value <= 8 ? static_cast<int>(*value) : 1;
    }
  }
  return 1;
}

// EXIF: 2 mirrored, 3 upside down, 4 both; 5 to 8 the same with rows and columns exchanged.
Image upright(const Image& image, int orientation) {
  if (orientation == 1) return image;
  const bool exchanged = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image result(exchanged ? image.height : image.width, exchanged ? image.width : image.height, image.channels);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      int column = exchanged ? y : x, row = exchanged ? x : y;
      if (from_right) column = image.width - 1 - column;
      if (from_below) row = image.height - 1 - row;
      std::copy_n(image.pixel(column, row), image.channels, result.pixel(x, y));
    }
  }
  return result;
}

}  // namespace

Image read_jpeg(const std::filesystem::path& path) {
  Image image = decode_plain_jpeg(path.string(), read_bytes(path));
  for (float& value : image.values) value = linear_from_srgb(value);
  return image;
}

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

Image decode_plain_jpeg(const std::string& file, std::string_view bytes) {
  Reader reader;
  const auto refuse = [&](const std::string& problem) { throw InputError(file, problem, remedy); };
  if (!is_jpeg(bytes) || !reader.read_header(bytes)) refuse("is no JPEG file, or is damaged");
  jpeg_decompress_struct& jpeg = reader.jpeg;
  const std::size_t pixels = static_cast<std::size_t>(jpeg.image_width) * jpeg.image_height;
  if (pixels > most_pixels_a_byte * bytes.size()) {
    refuse(fmt::format("announces {} x {} pixels, more than its {} bytes can hold", jpeg.image_width, jpeg.image_height,
                       bytes.size()));
  }
  if (jpeg.num_components != 1 && jpeg.num_components != 3) {
    throw InputError(file, fmt::format("has {} colour channels", jpeg.num_components), "save it as RGB");
  }
  const int channels = jpeg.num_components, turn = orientation(jpeg);  // markers are gone afterwards
  jpeg.out_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  std::vector<unsigned char> codes(pixels * static_cast<std::size_t>(channels));
  if (!reader.read_pixels(codes)) refuse(fmt::format("is damaged or cut short ({})", reader.message.data()));
  Image image(static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height), channels);
  std::ranges::transform(codes, image.values.begin(),
                         [](unsigned char code) { return static_cast<float>(code) / 255; });
  return upright(image, turn);
}

}  // namespace partwise
