// OpenEXR files, by the OpenEXR library: linear images, and what else a pixel may hold (normals, depth).
//
// Written: scan lines, ZIP (lossless), half or single precision; half takes what is beyond +-65504 to there. The same
// image gives the same bytes. Atomic. Read: scan lines and tiles with every compression that the library knows (DWAB
// among them), of a file of several parts the first; half, float and uint become float. Values are as they are:
// negative, infinite and NaN ones too.
//
// Errors: InputError for a file that cannot be read, is no OpenEXR file, is cut short, is deep, has subsampled
// channels, lacks the channels that are asked for, or announces more pixels than its bytes can hold; for one that
// cannot be written.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/imaging/image.h"

namespace partwise {

enum class ExrPrecision { half, single };

struct ExrLayer {
  Image image;
  std::vector<std::string> channels;  // one a channel of the image, for example normal.X, normal.Y, normal.Z
  ExrPrecision precision = ExrPrecision::single;
};

// Y, Y A, R G B or R G B A.
std::string encode_exr(const Image& image, ExrPrecision precision = ExrPrecision::half);
// All layers in one file; they have the same size, and no name stands twice.
std::string encode_exr(std::span<const ExrLayer> layers);
void write_exr(const std::filesystem::path& path, const Image& image, ExrPrecision precision = ExrPrecision::half);
void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers);

// R G B, with A where there is one; else Y, with A where there is one; else the only channel that there is.
Image read_exr(const std::filesystem::path& path);
// The channels of these names, 1 to 4, in this order.
Image read_exr(const std::filesystem::path& path, std::span<const std::string> channels);
// The same of bytes that are in memory; messages call them `file`. No names: as read_exr(path).
Image decode_exr(const std::string& file, std::string_view bytes, std::span<const std::string> channels = {});

}  // namespace partwise
