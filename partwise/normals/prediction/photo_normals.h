// The normals of the object on a photo (dissertation, section 4.2), or of a whole picture of a scene (section 4.3).
//
// A square about the object (editing/photo.h), or the picture, is reduced or enlarged to the size of the pictures that
// the network learnt from, and looked at both ways (NormalPredictor::both_ways); what is found is enlarged to the
// photo's pixels again, bilinearly. So photos of any size are read with what they show as large as it was in training,
// and detail finer than the network's pixels is not seen. Where an object is thinner than these, the normals beside it
// go on.
//
// Results: 3 channels, as large as the photo, unit vectors (+x right, +y up, +z towards the camera); of an object zero
// where half of a pixel or less is object. Time: two passes of the network and O(n) for n pixels. Errors: CheckFailed
// for a scene and a network that takes pictures of one size only; for a picture that has not 3 channels.
#pragma once

#include "partwise/editing/photo.h"
#include "partwise/normals/prediction/normal_predictor.h"

namespace partwise {

// All regions of the photo are the one object.
Image photo_normals(const NormalPredictor& predictor, const Photo& photo);

// Values as they are shown. The picture's longer side becomes the network's size.
Image scene_normals(const NormalPredictor& predictor, const Image& shown);

}  // namespace partwise
