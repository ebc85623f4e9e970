// Images of one size side by side, as contact sheets have them.
#pragma once

#include <span>

#include "partwise/imaging/image.h"

namespace partwise {

// `columns` in a row, row by row; what is left of the last row is 0. Errors: CheckFailed for no image, no column, or
// images of different sizes or channels.
Image tile(std::span<const Image> images, int columns);

}  // namespace partwise
