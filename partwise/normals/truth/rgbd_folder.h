// The frames in a folder, whichever of the four data sets (rgbd_frame.h) laid it out.
//
//   SUN RGB-D  image/, depth/ and intrinsics.txt, one frame a folder
//   TUM        rgb.txt and depth.txt, which name files and their times; freiburg1, 2 or 3 in the folder's name tells
//              the camera
//   Redwood    depth/ beside color/, image/ or rgb/; a pair has the same name up to the first hyphen; an intrinsics.txt
//              beside them is the camera of all, where there is one
//   NYU, raw   d-TIME-....pgm and r-TIME-....ppm
//   pairs      NYU_depth.pgm and NYU_color.ppm, SUN_depth.png and SUN_color.jpg, TUM_... and Redwood_... likewise
//
// Where files have times, each depth goes with the colour nearest in time, within 0.02 s (as TUM's own tool has it);
// depths without one are left out. Errors: InputError for a folder that is none of these or has no pair, and for a list
// that cannot be read.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/normals/truth/rgbd_frame.h"

namespace partwise {

// In the order of their times or names.
std::vector<RgbdFiles> find_rgbd_frames(const std::filesystem::path& folder);

}  // namespace partwise
