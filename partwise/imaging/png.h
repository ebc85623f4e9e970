// PNG files, by libpng.
//
// Written: 8 bits a channel, sRGB (and marked as such), colours clamped to [0, 1] and rounded to the nearest code,
// alpha linear. The same image gives the same bytes. Atomic. Read: any PNG. Palettes are expanded, 16 bits keep their
// precision, sRGB is assumed and made linear.
//
// Errors: InputError for a file that cannot be read, is no PNG, or is cut short; for one that cannot be written.
#pragma once

#include <filesystem>
#include <string>

#include "partwise/imaging/image.h"

namespace partwise {

std::string encode_png(const Image& image);
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);

}  // namespace partwise
