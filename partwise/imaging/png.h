// PNG files, by libpng.
//
// Written: 8 bits a channel, sRGB (and marked as such), colours clamped to [0, 1] and rounded to the nearest code,
// alpha linear. The same image gives the same bytes. Atomic. Read: any PNG. Palettes are expanded, 16 bits keep their
// precision, sRGB is assumed and made linear.
//
// Errors: InputError for a file that cannot be read, is no PNG, is cut short, or announces more pixels than its bytes
// can hold; for one that cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partwise/imaging/image.h"

namespace partwise {

std::string encode_png(const Image& image);
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
Image decode_png(const std::string& file, std::string_view bytes);

}  // namespace partwise
