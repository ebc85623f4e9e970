// A shape in the plane from any file that the planar room takes: polygon files (geometry/polygon_io.h) and masks.
//
// A mask is a PNG. A pixel counts by its luminance as coded (0 to 1), times its alpha; what is above one half is
// inside, and the outline runs at one half between pixels, in pixel coordinates, y down (geometry/contours.h).
//
// Errors: InputError, also for a mask that is empty.
#pragma once

#include <filesystem>

#include "partwise/geometry/polygon_io.h"
#include "partwise/imaging/image.h"

namespace partwise {

PolygonFile read_shape(const std::filesystem::path& path, const PolygonReadSettings& settings = {});

// Whether the name ends in .png, in any case of letters.
bool is_png_name(const std::filesystem::path& path);

// The shape of a mask that is in memory; `place` is named in messages.
PolygonFile mask_shape(const Image& mask, bool repair, const std::string& place);

}  // namespace partwise
