// One picture with its depth, as four public data sets store them.
//
//   NYU Depth v2, raw (Silberman, Hoiem, Kohli, Fergus 2012): colour .ppm and depth .pgm of 16 bits. The depth's bytes
//     stand low byte first, against the format; a code d is 351.3 / (1092.5 - d) metres, up to 10; what is beyond is
//     missing. Colour and depth are of two cameras, not registered (registration.h).
//   SUN RGB-D (Song, Lichtenberg, Xiao 2015): PNG of 16 bits, millimetres turned left by 3 bits; intrinsics.txt.
//   TUM RGB-D (Sturm, Engelhard, Endres, Burgard, Cremers 2012): PNG of 16 bits, 5000 a metre.
//   Redwood (Choi, Zhou, Miller, Koltun 2016; Choi, Zhou, Koltun 2015): PNG of 16 bits, millimetres.
//
// Intrinsics are those of the data set's own pages for 640 x 480, or of the file. Depth is along the viewing direction.
// Errors: InputError for files that cannot be read, are not of the format, or of sizes that do not fit each other.
#pragma once

#include <filesystem>
#include <string>

#include "partwise/imaging/image.h"
#include "partwise/normals/truth/pinhole_camera.h"

namespace partwise {

enum class RgbdFormat { nyu, sun, tum, redwood };

struct RgbdFiles {
  RgbdFormat format = RgbdFormat::redwood;
  std::filesystem::path colour, depth;
  // A file of 9 numbers, the matrix (focal_x 0 centre_x, 0 focal_y centre_y, 0 0 1); empty: the data set's camera.
  std::filesystem::path intrinsics{};
  // Of TUM's three cameras 1, 2 or 3; 0: what the data set's page gives for all.
  int tum_camera = 0;
};

struct RgbdFrame {
  Image colour;          // linear RGB
  Image depth;           // 1 channel, metres, 0 where missing; of the colour's size
  PinholeCamera camera;  // of the depth
};

RgbdFrame read_rgbd_frame(const RgbdFiles& files);

// The depth alone, and the camera alone for pictures of that size.
Image read_rgbd_depth(const RgbdFiles& files);
PinholeCamera read_rgbd_camera(const RgbdFiles& files, int width, int height);

}  // namespace partwise
