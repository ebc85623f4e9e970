// JPEG files, by libjpeg: what cameras and phones write. Read only.
//
// Grey or RGB, 8 bits, sRGB: made linear, or values as they are shown, codes over 255. Turned upright as the file's
// EXIF orientation says. Errors: InputError for a file that cannot be read, is no JPEG, is damaged or cut short, has
// the four colours of print, or announces more pixels than its bytes can hold.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partwise/imaging/image.h"

namespace partwise {

Image read_jpeg(const std::filesystem::path& path);
bool is_jpeg(std::string_view bytes);
Image decode_plain_jpeg(const std::string& file, std::string_view bytes);

}  // namespace partwise
