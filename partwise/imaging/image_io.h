// Images by the ending of the file, in any case of letters: .exr, .hdr (.pic), .png, .jpg (.jpeg), .pgm, .ppm. See
// exr.h, hdr.h, png.h, jpeg.h and netpbm.h.
//
// Errors: InputError for another ending, and those of the formats.
#pragma once

#include <filesystem>

#include "partwise/imaging/image.h"

namespace partwise {

// Linear light.
Image read_image(const std::filesystem::path& path);

}  // namespace partwise
