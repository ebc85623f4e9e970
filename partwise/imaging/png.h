// PNG files, by libpng.
//
// Written: 8 bits a channel, sRGB (and marked as such), colours clamped to [0, 1] and rounded to the nearest code,
// alpha linear; or values as they are, 0 to 1 as the codes of 8 or 16 bits, for what is no light (normals, masks,
// labels) or has its curve already. The same image gives the same bytes. Atomic. Read: any PNG. Palettes are expanded,
// 16 bits keep their precision; sRGB is assumed and made linear, or values stay as they are.
//
// Errors: InputError for a file that cannot be read, is no PNG, is cut short, or announces more pixels than its bytes
// can hold; for one that cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partwise/imaging/image.h"

namespace partwise {

enum class PngCodes { srgb, plain8, plain16 };

std::string encode_png(const Image& image, PngCodes codes = PngCodes::srgb);
void write_png(const std::filesystem::path& path, const Image& image, PngCodes codes = PngCodes::srgb);
Image read_png(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
Image decode_png(const std::string& file, std::string_view bytes);
// The codes over the largest code, whatever curve they have.
Image read_plain_png(const std::filesystem::path& path);
Image decode_plain_png(const std::string& file, std::string_view bytes);

}  // namespace partwise
