// The normals of the object on a photo (dissertation, section 4.2).
//
// A square about the object (editing/photo.h) is reduced or enlarged to the size of the pictures that the network
// learnt from; what it finds is enlarged to the photo's pixels again, bilinearly. So photos of any size are read with
// the object as large as it was in training, and detail finer than the network's pixels is not seen. Where the object
// is thinner than these, the normals beside it go on.
//
// Result: 3 channels, as large as the photo, unit vectors (+x right, +y up, +z towards the camera), zero where half of
// a pixel or less is object. Time: one pass of the network and O(n) for n pixels. Errors: none of its own.
#pragma once

#include "partwise/editing/photo.h"
#include "partwise/normals/prediction/normal_predictor.h"

namespace partwise {

// All regions of the photo are the one object.
Image photo_normals(const NormalPredictor& predictor, const Photo& photo);

}  // namespace partwise
