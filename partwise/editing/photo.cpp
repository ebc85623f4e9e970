#include "partwise/editing/photo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/imaging/jpeg.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

constexpr float covered = 0.5f;
constexpr double margin = 1.1;
constexpr double plain_share = 0.9;

bool has_transparency(const Image& image) { return image.channels == 2 || image.channels == 4; }

std::size_t pixels_of(const Image& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

// One channel of an image.
Image channel(const Image& image, int number) {
  Image result(image.width, image.height, 1);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = image.values[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(number)];
  return result;
}

Image colours(const Image& image) {
  Image result(image.width, image.height, 3);
  const bool grey = image.channels < 3;
  for (std::size_t i = 0; i < pixels_of(image); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      result.values[3 * i + c] = image.values[i * static_cast<std::size_t>(image.channels) + (grey ? 0 : c)];
  return result;
}

Image read_mask(const std::filesystem::path& path, const Image& photo) {
  const Image file = read_plain_png(path);
  if (file.width != photo.width || file.height != photo.height) {
    throw InputError(path.string(),
                     fmt::format("is {} x {}, the photo {} x {}", file.width, file.height, photo.width, photo.height),
                     "give a mask of the photo's size");
  }
  Image mask(file.width, file.height, 1);
  const int channels = std::min(file.channels, has_transparency(file) ? file.channels - 1 : file.channels);
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    float sum = 0;
    for (int c = 0; c < channels; ++c)
      sum += file.values[i * static_cast<std::size_t>(file.channels) + static_cast<std::size_t>(c)];
    mask.values[i] = sum / static_cast<float>(channels);
  }
  if (std::ranges::none_of(mask.values, [](float value) { return value > covered; })) {
    throw InputError(path.string(), "is dark everywhere", "paint what is to be changed white");
  }
  return mask;
}

// The median colour of the outermost pixels; nothing where they differ too much.
struct Border {
  std::array<float, 3> colour{};
  bool plain = false;
};

bool near(const float* colour, const std::array<float, 3>& other) {
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(colour[c] - other[c]) > plainness) return false;
  return true;
}

Border border_of(const Image& shown) {
  std::vector<const float*> pixels;
  for (int x = 0; x < shown.width; ++x) {
    for (const int y : {0, shown.height - 1}) pixels.push_back(shown.pixel(x, y));
  }
  for (int y = 1; y < shown.height - 1; ++y) {
    for (const int x : {0, shown.width - 1}) pixels.push_back(shown.pixel(x, y));
  }
  Border border;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> values;
    values.reserve(pixels.size());
    for (const float* each : pixels) values.push_back(each[c]);
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    border.colour[c] = values[values.size() / 2];
  }
  const auto alike = std::ranges::count_if(pixels, [&](const float* each) { return near(each, border.colour); });
  border.plain = static_cast<double>(alike) >= plain_share * static_cast<double>(pixels.size());
  return border;
}

// What is not reached from the border through pixels of its colour.
Image off_plain_background(const Image& shown, const Border& border) {
  Image mask(shown.width, shown.height, 1, 1);
  std::vector<std::pair<int, int>> open;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= shown.width || y >= shown.height) return;
    float& here = *mask.pixel(x, y);
    if (here == 0 || !near(shown.pixel(x, y), border.colour)) return;
    here = 0;
    open.emplace_back(x, y);
  };
  for (int x = 0; x < shown.width; ++x) {
    visit(x, 0);
    visit(x, shown.height - 1);
  }
  for (int y = 0; y < shown.height; ++y) {
    visit(0, y);
    visit(shown.width - 1, y);
  }
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return mask;
}

bool is_object(const Image& mask) {
  return std::ranges::any_of(mask.values, [](float value) { return value > covered; });
}

Image found_object(const std::filesystem::path& path, const Photo& photo) {
  const char* remedy = "give a mask with --mask, white where the object is";
  if (photo.has_alpha) {
    if (!is_object(photo.alpha)) throw InputError(path.string(), "is transparent everywhere", remedy);
    return photo.alpha;
  }
  const Border border = border_of(photo.shown);
  if (!border.plain) throw InputError(path.string(), "has no plain background to tell the object from", remedy);
  Image mask = off_plain_background(photo.shown, border);
  if (!is_object(mask)) throw InputError(path.string(), "is one plain area without an object", remedy);
  return mask;
}

Image read_codes(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  return is_jpeg(bytes) ? decode_plain_jpeg(path.string(), bytes) : decode_plain_png(path.string(), bytes);
}

}  // namespace

Image read_shown(const std::filesystem::path& path) { return colours(read_codes(path)); }

Photo read_photo(const std::filesystem::path& path, const std::vector<std::filesystem::path>& masks) {
  const Image file = read_codes(path);
  Photo photo;
  photo.shown = colours(file);
  photo.alpha = has_transparency(file) ? channel(file, file.channels - 1) : Image(file.width, file.height, 1, 1);
  photo.has_alpha = std::ranges::any_of(photo.alpha.values, [](float value) { return value <= covered; });
  if (masks.empty()) {
    photo.regions.push_back(found_object(path, photo));
    return photo;
  }
  for (const std::filesystem::path& each : masks) {
    Image region = read_mask(each, photo.shown);
    for (Image& earlier : photo.regions)
      for (std::size_t i = 0; i < region.values.size(); ++i)
        earlier.values[i] = std::min(earlier.values[i], 1 - region.values[i]);
    photo.regions.push_back(std::move(region));
  }
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (!is_object(photo.regions[i]))
      throw InputError(masks[i].string(), "lies wholly under a later mask", "leave it out, or give it later");
  }
  return photo;
}

Crop crop_of(const Photo& photo, double largest_share) {
  int left = photo.shown.width, right = 0, top = photo.shown.height, bottom = 0;
  double area = 0;
  for (const Image& region : photo.regions) {
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        if (*region.pixel(x, y) <= covered) continue;
        left = std::min(left, x);
        right = std::max(right, x + 1);
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1);
        ++area;
      }
    }
  }
  const double side = std::max(margin * std::max(right - left, bottom - top), std::sqrt(area / largest_share));
  Crop crop;
  crop.side = std::max(static_cast<int>(std::ceil(side)), 1);
  crop.x = (left + right - crop.side) / 2;
  crop.y = (top + bottom - crop.side) / 2;
  return crop;
}

}  // namespace partwise
