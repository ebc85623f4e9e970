// What was read off a photo, as files in a folder: normals.png (16 bits, (n + 1) / 2, background the zero vector),
// light.exr (linear radiance, 128 x 64), material.json and ball.png (of further regions material-2.json ...),
// picture.png (what the networks saw) and rendered.png (what the layers look like together).
//
// Errors: InputError where the folder cannot be made or written.
#pragma once

#include <filesystem>

#include "partwise/editing/edit_photo.h"

namespace partwise {

void write_layers(const std::filesystem::path& folder, const PhotoLayers& layers, const MaterialRange& range);

}  // namespace partwise
