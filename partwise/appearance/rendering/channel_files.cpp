#include "partwise/appearance/rendering/channel_files.h"

#include "partwise/base/error.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {

std::string encode_tone_mapped(const Image& linear, float exposure) {
  Image mapped = tone_map(linear, exposure);
  for (float& value : mapped.values) value /= 255;
  return encode_png(mapped, PngCodes::plain8);  // the codes have their curve already
}

std::string encode_tone_mapped(const Image& linear, const Image& mask) {
  return encode_tone_mapped(linear, exposure_by_median(linear, mask));
}

std::string encode_normals(const GBuffer& seen) { return encode_normals(seen.normal_image()); }

std::string encode_normals(const Image& normals, PngCodes codes) {
  PARTWISE_CHECK(normals.channels, ==, 3);
  Image coded = normals;
  for (float& value : coded.values) value = (value + 1) / 2;
  return encode_png(coded, codes);
}

std::string encode_mask(const GBuffer& seen) { return encode_png(seen.mask_image(), PngCodes::plain8); }

std::string encode_parts(const GBuffer& seen) {
  constexpr int most = 65535;
  Image image(seen.size.width, seen.size.height, 1);
  const std::vector<int> parts = seen.part_of_pixels();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    PARTWISE_CHECK(parts[i] + 1, <=, most);
    image.values[i] = static_cast<float>(parts[i] + 1) / most;
  }
  return encode_png(image, PngCodes::plain16);
}

}  // namespace partwise
