// Normals in files, by the ending of the name: PNG of 8 or 16 bits, or OpenEXR.
//
//   .png  (n + 1) / 2: red to the right, green up, blue to the camera; a zero vector is the middle grey
//   .exr  channels X, Y, Z in single precision, as they are
//
// In memory: 3 channels, +x right, +y up, +z towards the camera, unit length, zero where there is none. What is read
// has unit length again (8 bits round by up to 0.4 degrees, 16 by 0.002); vectors shorter than half are taken for none.
// Atomic. Errors: InputError for another ending, for a file that cannot be read or written, or that has other channels.
#pragma once

#include <filesystem>

#include "partwise/imaging/image.h"

namespace partwise {

enum class NormalBits { eight, sixteen };  // of .png

void write_normals(const std::filesystem::path& path, const Image& normals, NormalBits bits = NormalBits::sixteen);
Image read_normals(const std::filesystem::path& path);

}  // namespace partwise
