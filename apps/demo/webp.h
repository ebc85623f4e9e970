// Pictures as WebP, which takes a tenth of what PNG takes for what looks like a photograph, and knows transparency.
#pragma once

#include <string>

#include "partwise/imaging/image.h"

namespace demo {

// Of a linear image of 3 channels, or 4 with alpha; lossy, 8 bits, sRGB. The same image gives the same bytes.
std::string encode_webp(const partwise::Image& image);

}  // namespace demo
