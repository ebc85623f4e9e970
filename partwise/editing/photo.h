// A photo of an object and where in it the object is: masks that are given, transparency, or a plain background.
//
// PNG or JPEG. Colours are kept as they are shown, 0 to 1. Masks are read from files of the photo's size, bright where
// the region is (alpha, where they have it, does not count); a region may lie over an earlier one, which it then takes
// away from. Without masks, what is transparent is background; without transparency, what hangs together with the
// photo's border and has its colour, if the border is plain: nine tenths of it within `plainness` of its median colour.
// Errors: InputError for a picture that cannot be read, a mask of another size or without a bright pixel, a photo
// without an object, or without a plain background where no mask is given.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/imaging/image.h"

namespace partwise {

struct Photo {
  Image shown;                 // 3 channels, 0 to 1
  std::vector<Image> regions;  // 1 channel each, covered share of the pixel
  Image alpha;                 // 1 channel, of the file; of one without it, all 1
  bool has_alpha = false;
};

Photo read_photo(const std::filesystem::path& path, const std::vector<std::filesystem::path>& masks);

// The colours alone, of a picture that is looked at whole: 3 channels, 0 to 1. What is transparent counts as any other.
Image read_shown(const std::filesystem::path& path);

inline constexpr float plainness = 0.04f;  // of a channel

// The square about the object that networks look at: the object with a margin, at most `largest_share` of the square.
// May reach beyond the photo.
struct Crop {
  int x = 0, y = 0, side = 0;
};
Crop crop_of(const Photo& photo, double largest_share = 0.5);

}  // namespace partwise
