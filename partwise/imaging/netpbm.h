// Netpbm's grey and colour pictures in bytes (PGM "P5", PPM "P6"), of 8 or 16 bits: what cameras with a depth sensor
// are often stored as. Read only.
//
// 16 bits have the high byte first, as the format says. Comments in the header are passed over; what follows the first
// picture is not read. sRGB is assumed and made linear, or values stay as they are, codes over the header's largest.
// Errors: InputError for a file that cannot be read, is none of these two (the older ones in text, PBM and PAM are
// not), has a damaged header, is cut short, announces more pixels than its bytes hold, or has codes above its largest.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "partwise/imaging/image.h"

namespace partwise {

Image read_netpbm(const std::filesystem::path& path);
Image read_plain_netpbm(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
Image decode_plain_netpbm(const std::string& file, std::string_view bytes);

}  // namespace partwise
