#include "partwise/learning/stored_views.h"

#include <ATen/Functions.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "partwise/appearance/synthesis/shard_reader.h"
#include "partwise/base/error.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

constexpr float steps = 32767;
constexpr float part_codes = 65535;
constexpr int most_parts = 255;

Image channel(const std::string& place, const ShardImage& image, const char* ending, int channels) {
  const auto found = image.files.find(ending);
  if (found == image.files.end()) {
    throw InputError(place, fmt::format("has no {}", ending), "make the data set with partwise dataset");
  }
  Image decoded = decode_plain_png(place + "." + ending, found->second);
  if (decoded.channels != channels) {
    throw InputError(place + "." + ending, fmt::format("has {} channels, not {}", decoded.channels, channels),
                     "make the data set with partwise dataset");
  }
  return decoded;
}

}  // namespace

StoredViews::StoredViews(const std::vector<std::filesystem::path>& folders, const Progress& progress) {
  std::vector<std::filesystem::path> shards;
  for (const auto& folder : folders) std::ranges::copy(shards_of(folder), std::back_inserter(shards));
  for (std::size_t i = 0; i < shards.size(); ++i) {
    progress("views", static_cast<double>(i) / static_cast<double>(shards.size()));
    ShardReader reader(shards[i]);
    while (const std::optional<ShardImage> image = reader.next()) {
      const std::string place = shards[i].string() + ":" + image->key;
      add(place, channel(place, *image, "normal.png", 3), channel(place, *image, "mask.png", 1),
          channel(place, *image, "part.png", 1));
    }
  }
}

void StoredViews::add(const std::string& place, const Image& normals, const Image& mask, const Image& parts) {
  if (side_ == 0) side_ = normals.width;
  for (const Image* each : {&normals, &mask, &parts}) {
    if (each->width != side_ || each->height != side_) {
      throw InputError(place,
                       fmt::format("is {} x {}, the first view {} x {}", each->width, each->height, side_, side_),
                       "use square views of one size");
    }
  }
  const auto pixels = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  View view{std::vector<std::int16_t>(pixels), std::vector<std::int16_t>(pixels), std::vector<std::uint8_t>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    if (mask.values[i] <= 0.5f) continue;
    const float x = 2 * normals.values[3 * i] - 1, y = 2 * normals.values[3 * i + 1] - 1;
    const float z = 2 * normals.values[3 * i + 2] - 1;
    const float length = z < 0 ? std::hypot(x, y) : std::hypot(x, y, z);
    if (!(length > 0.5f)) continue;  // half background and half object: no normal there
    view.x[i] = static_cast<std::int16_t>(std::lround(steps * x / length));
    view.y[i] = static_cast<std::int16_t>(std::lround(steps * y / length));
    const auto part = std::lround(part_codes * parts.values[i]);
    view.part[i] = static_cast<std::uint8_t>(std::clamp(part, 1L, static_cast<long>(most_parts)));
  }
  views_.push_back(std::move(view));
}

at::Tensor StoredViews::normals(std::int64_t number, bool mirrored) const {
  const View& view = views_[static_cast<std::size_t>(number)];
  at::Tensor result = at::zeros({3, side_, side_});
  const auto pixels = static_cast<std::int64_t>(view.part.size());
  float* planes = result.data_ptr<float>();
  for (std::int64_t i = 0; i < pixels; ++i) {
    if (view.part[i] == 0) continue;
    const float x = view.x[i] / steps, y = view.y[i] / steps;
    planes[i] = x;
    planes[pixels + i] = y;
    planes[2 * pixels + i] = std::sqrt(std::max(0.0f, 1 - x * x - y * y));
  }
  if (!mirrored) return result;
  result = result.flip(2);
  result[0].neg_();
  return result;
}

at::Tensor StoredViews::parts(std::int64_t number, bool mirrored) const {
  const View& view = views_[static_cast<std::size_t>(number)];
  at::Tensor result = at::empty({side_, side_}, at::kByte);
  std::copy(view.part.begin(), view.part.end(), result.data_ptr<std::uint8_t>());
  return mirrored ? result.flip(1) : result;
}

}  // namespace partwise
