// Radiance pictures (.hdr, .pic; Ward 1991): linear RGB with one exponent a pixel.
//
// Written: RGBE, run lengths by component, rows from the top; negative values become 0, values beyond the format's
// largest that. A value is kept to 1/256 of the largest component of its pixel. Atomic. Read: RGBE, plain, with runs by
// component or with the older runs of pixels, rows from the top (-Y H +X W). Lines EXPOSURE are taken out again.
//
// Errors: InputError for a file that cannot be read, is no Radiance picture, is XYZE or turned, is cut short, holds
// runs longer than a row, or announces more pixels than its bytes can hold; for one that cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partwise/imaging/image.h"

namespace partwise {

// image: 3 channels.
std::string encode_hdr(const Image& image);
void write_hdr(const std::filesystem::path& path, const Image& image);
Image read_hdr(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
Image decode_hdr(const std::string& file, std::string_view bytes);

}  // namespace partwise
