// Decompositions of a shape in the plane from any origin: polygons (geometry/polygon_io.h), a part each, or a label
// image.
//
// A label image is a PNG without smoothing: pixels of one colour or grey level are one part, wherever they lie; black
// and fully transparent pixels belong to none. Its parts come as polygons along the sides of the pixels, with a corner
// wherever pixels meet, so that neighbours share their sides exactly; pixel coordinates, y down, as masks have them.
//
// Errors: InputError, also for an image without a part, or of more than 4096 colours.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/geometry/polygon.h"
#include "partwise/imaging/image.h"

namespace partwise {

struct PlanarSegmentation {
  Polygons polygons;
  std::vector<int> part;  // of each polygon
};

PlanarSegmentation read_segmentation(const std::filesystem::path& path);

// Parts are numbered as they come, row by row; `place` is named in messages.
PlanarSegmentation label_image_segmentation(const Image& labels, const std::string& place);

}  // namespace partwise
