// What is known of the pixels of an image, in the bytes of a PNG file.
//
//   image    8 bits: an exposure that is given, or by the median of the foreground, gamma 2.2 (imaging/tone_mapping.h)
//   normals  16 bits, or 8 on request, (n + 1) / 2: red right, green up, blue to the camera; none: the zero vector
//   mask     8 bits, the share of the pixel that is covered
//   parts    16 bits, 0 for none, k + 1 for part k
//
// The same image gives the same bytes. Errors: CheckFailed for a part beyond 65534.
#pragma once

#include <string>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/imaging/image.h"
#include "partwise/imaging/png.h"

namespace partwise {

std::string encode_tone_mapped(const Image& linear, float exposure);
std::string encode_tone_mapped(const Image& linear, const Image& mask);
std::string encode_normals(const GBuffer& seen);
std::string encode_normals(const Image& normals, PngCodes codes = PngCodes::plain16);
std::string encode_mask(const GBuffer& seen);
std::string encode_parts(const GBuffer& seen);

}  // namespace partwise
