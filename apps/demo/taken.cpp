#include "taken.h"

#include <algorithm>
#include <cmath>

#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/imaging/tone_mapping.h"

namespace demo {
namespace {

using namespace partwise;

constexpr int picture_size = 320, light_rows = 128;
constexpr float ground = 0.94f;  // behind the models, as shops photograph things

Image on_ground(const Image& codes) {
  Image result(codes.width, codes.height, 3);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const float alpha = codes.values[i / 3 * 4 + 3];
    result.values[i] = ground + alpha * (codes.values[i / 3 * 4 + i % 3] - ground);
  }
  return result;
}

Image displayed(const Image& linear, float exposure) {
  Image codes = tone_map(linear, exposure);
  for (float& value : codes.values) value /= 255;
  return codes;
}

Image share_of_part(const GBuffer& seen, int part) {
  const std::vector<int> parts = seen.part_of_pixels();
  Image share = seen.mask_image();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i] != part) share.values[i] = 0;
  }
  return share;
}

}  // namespace

Taken taken(const WornModel& model, const std::vector<std::string>& materials, const std::string& light, double azimuth,
            bool parts_apart) {
  Taken result{view_of(model, azimuth, picture_size, 0.5), resized_light(light, light_rows), materials, 0, {}};
  const Image mask = result.seen.mask_image();
  const Image image = worn_image(result.seen, brdfs_of(materials), result.light, true);
  result.exposure = exposure_by_median(image, mask);
  result.photo.shown = on_ground(displayed(on_clear_ground(image, mask), result.exposure));
  result.photo.alpha = Image(picture_size, picture_size, 1, 1);
  if (parts_apart) {
    for (int part = 0; part < static_cast<int>(materials.size()); ++part)
      result.photo.regions.push_back(share_of_part(result.seen, part));
  } else {
    result.photo.regions.push_back(mask);
  }
  return result;
}

Image exposed_anew(const Image& shown, const Image& mask) {
  Image object(shown.width, shown.height, 4);  // linear, without the ground
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    const float share = mask.values[i];
    for (std::size_t c = 0; c < 3 && share > 0; ++c) {
      const float own = (shown.values[3 * i + c] - (1 - share) * ground) / share;
      object.values[4 * i + c] = std::pow(std::clamp(own, 0.0f, 1.0f), 2.2f);
    }
    object.values[4 * i + 3] = share;
  }
  return on_ground(displayed(object, exposure_by_median(object, mask)));
}

WornModel whole(WornModel model) {
  model.parts.assign(model.parts.size(), 0);
  return model;
}

}  // namespace demo
