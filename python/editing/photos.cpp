#include "photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "arrays.h"
#include "partwise/base/error.h"

namespace partwise::python {
namespace {

// Bytes become 0 to 1.
Image shown_in(const py::handle& given, const std::string& name) {
  const py::array array = py::array::ensure(given);
  const bool bytes = array && array.dtype().kind() == 'u' && array.itemsize() == 1;
  Image image = image_in(given, name);
  for (float& value : image.values) {
    if (bytes) value /= 255;
    if (value >= 0 && value <= 1) continue;
    throw InputError(name, fmt::format("holds {}", value), "give values as they are shown: 0 to 1, or uint8");
  }
  return image;
}

Image channels_of(const Image& image, int first, int count) {
  Image result(image.width, image.height, count);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) std::copy_n(image.pixel(x, y) + first, count, result.pixel(x, y));
  }
  return result;
}

// A region takes what it covers away from those before it.
void add_region(Photo& photo, Image mask) {
  for (Image& earlier : photo.regions) {
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
      earlier.values[i] = std::min(earlier.values[i], 1 - mask.values[i]);
    }
  }
  photo.regions.push_back(std::move(mask));
}

bool shows_something(const Image& mask) {
  return std::ranges::any_of(mask.values, [](float value) { return value > 0.5f; });
}

Photo photo_of_array(const py::object& given, const py::sequence& masks) {
  const Image image = shown_in(given, "photo");
  if (image.channels < 3) {
    throw InputError("photo", fmt::format("has {} channels", image.channels), "give 3, or 4 with transparency");
  }
  Photo photo;
  photo.shown = channels_of(image, 0, 3);
  photo.alpha = image.channels == 4 ? channels_of(image, 3, 1) : Image(image.width, image.height, 1, 1);
  photo.has_alpha = std::ranges::any_of(photo.alpha.values, [](float value) { return value <= 0.5f; });
  for (const py::handle& each : masks) {
    Image mask = shown_in(each, fmt::format("masks[{}]", photo.regions.size()));
    if (mask.width != image.width || mask.height != image.height || mask.channels != 1) {
      throw InputError(fmt::format("masks[{}]", photo.regions.size()),
                       fmt::format("is {} x {} x {}", mask.height, mask.width, mask.channels),
                       fmt::format("give one that is {} x {}, as the photo", image.height, image.width));
    }
    add_region(photo, std::move(mask));
  }
  if (photo.regions.empty()) {
    if (!photo.has_alpha) throw InputError("photo", "has no transparency to tell the object by", "give masks=[...]");
    photo.regions.push_back(photo.alpha);
  }
  for (const Image& region : photo.regions) {
    if (!shows_something(region)) throw InputError("masks", "leave a region nothing", "paint what is to be changed 1");
  }
  return photo;
}

bool is_path(const py::handle& given) { return py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"); }

}  // namespace

Image shown_in_whole(const py::object& given) {
  if (is_path(given)) {
    const std::filesystem::path file = py::str(given).cast<std::string>();
    const py::gil_scoped_release released;
    return read_shown(file);
  }
  Image image = shown_in(given, "photo");
  if (image.channels != 3)
    throw InputError("photo", fmt::format("has {} channels", image.channels), "give one that is h x w x 3");
  return image;
}

Photo photo_in(const py::object& given, const py::object& masks) {
  py::sequence list = py::list();
  if (!masks.is_none()) list = py::sequence(masks);
  if (!is_path(given)) return photo_of_array(given, list);
  std::vector<std::filesystem::path> files;
  for (const py::handle& each : list) {
    if (!is_path(each))
      throw InputError("masks", "holds an array for a photo in a file", "give masks in files as well");
    files.emplace_back(py::str(each).cast<std::string>());
  }
  const std::filesystem::path file = py::str(given).cast<std::string>();
  const py::gil_scoped_release released;
  return read_photo(file, files);
}

}  // namespace partwise::python
