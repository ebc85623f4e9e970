#include "webp.h"

#include <webp/encode.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "partwise/base/error.h"

namespace demo {
namespace {

std::vector<std::uint8_t> codes_of(const partwise::Image& image) {
  std::vector<std::uint8_t> codes;
  codes.reserve(image.values.size());
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float value = i % channels == 3 ? image.values[i] : partwise::srgb_from_linear(image.values[i]);
    codes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))));
  }
  return codes;
}

}  // namespace

std::string encode_webp(const partwise::Image& image) {
  WebPConfig config;
  PARTWISE_CHECK(WebPConfigInit(&config), !=, 0);
  config.quality = 86;
  config.use_sharp_yuv = 1;  // edges between coloured parts stay sharp
  WebPPicture picture;
  PARTWISE_CHECK(WebPPictureInit(&picture), !=, 0);
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const std::vector<std::uint8_t> codes = codes_of(image);
  const auto import = image.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
  const bool done =
      import(&picture, codes.data(), image.channels * image.width) != 0 && WebPEncode(&config, &picture) != 0;
  std::string bytes(reinterpret_cast<const char*>(writer.mem), writer.size);
  WebPPictureFree(&picture);
  WebPMemoryWriterClear(&writer);
  PARTWISE_CHECK(done, ==, true);
  return bytes;
}

}  // namespace demo
