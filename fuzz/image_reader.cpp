// What libFuzzer calls: one reader of images, chosen by PARTWISE_FUZZ_FORMAT. Whatever the bytes, the
// outcome is an image or an InputError of one line.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "fuzz/outcome.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/hdr.h"
#include "partwise/imaging/jpeg.h"
#include "partwise/imaging/netpbm.h"

namespace {

using namespace partwise;
using namespace partwise::fuzz;

constexpr std::string_view format = PARTWISE_FUZZ_FORMAT;

// Images are small here: what takes time and memory is filling many pixels, not reading them.
bool is_large_exr(std::string_view bytes) {
  constexpr std::string_view name("dataWindow\0box2i\0", 17);
  constexpr std::int64_t most = 1 << 20;
  for (std::size_t at = bytes.find(name); at != std::string_view::npos; at = bytes.find(name, at + 1)) {
    std::int32_t box[4];
    if (at + name.size() + 4 + sizeof(box) > bytes.size()) return false;
    std::memcpy(box, bytes.data() + at + name.size() + 4, sizeof(box));
    const std::int64_t width = std::int64_t{box[2]} - box[0] + 1, height = std::int64_t{box[3]} - box[1] + 1;
    if (width > most || height > most || width * height > most) return true;
  }
  return false;
}

bool is_large_jpeg(std::string_view bytes) {
  constexpr int most = 1024;
  for (std::size_t at = 0; at + 9 < bytes.size(); ++at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[at + i]); };
    if (byte(0) != 0xFF || byte(1) < 0xC0 || byte(1) > 0xCF) continue;  // a frame's header, or what looks like it
    if ((byte(5) << 8 | byte(6)) > most || (byte(7) << 8 | byte(8)) > most) return true;
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (format == "exr" && is_large_exr(bytes)) return 0;
  if (format == "jpg" && is_large_jpeg(bytes)) return 0;
  expect_message_or([&] {
    const Image image = format == "exr"   ? decode_exr("fuzz", bytes)
                        : format == "hdr" ? decode_hdr("fuzz", bytes)
                        : format == "pgm" ? decode_plain_netpbm("fuzz", bytes)
                                          : decode_plain_jpeg("fuzz", bytes);
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (pixels == 0 || image.values.size() != pixels * static_cast<std::size_t>(image.channels))
      give_up("an image of no size");
  });
  return 0;
}
