// What was read off a photo (edit_photo.h), as pictures to look at: values as they are shown, 0 to 1. All but the ball
// are as large as what the networks see. Errors: none.
#pragma once

#include "partwise/editing/edit_photo.h"
#include "partwise/imaging/image.h"

namespace partwise {

// The square about the object, of the photo or of an edit of it; its first 3 channels.
Image square_picture(const Image& photo, const PhotoLayers& layers);

Image seen_picture(const PhotoLayers& layers);  // 4 channels: colours and mask
Image rendered_picture(const PhotoLayers& layers, const MaterialRange& range);
Image normals_picture(const PhotoLayers& layers);  // (n + 1) / 2

// A ball in a region's material under the light that was found; 4 channels.
Image ball_picture(const PhotoLayers& layers, const MaterialRange& range, int region, int size);

}  // namespace partwise
