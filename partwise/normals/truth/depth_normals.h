// Normals in camera space from a picture of depth: a plane is fitted about every pixel, to what belongs to its surface.
//
// The inverse depth of a plane is a linear function of the pixel, 1 / Z = A u + B v + C on rays (u, v, -1), and the
// plane's normal is (-A, -B, C) but for its length (Fan, Wang, Bocus, Pitas 2021, of differences; here by least
// squares). Sensors that triangulate measure inverse depth, with an error that is the same for near and far (Khoshelham
// and Elberink 2012), so the fit weighs all pixels alike, planes come out exact at any slant, and the expected error of
// a normal is known: windows grow until it is small enough.
//
// What belongs to the surface: in rows and columns, neighbours whose step of inverse depth lies between the steps
// beside it, or nearly so; then all in the rows that the pixel's column crosses (the regions of Zhang, Lu, Lafruit
// 2009). So a step edge parts two surfaces however slanted they are, and a crease does not. Short gaps are passed over.
//
// Row sums make a window of radius r cost O(r): O(n r) time for n pixels, O(n) memory. Double precision; the same bytes
// for any number of threads. Errors: CheckFailed for an image that is no depth, a camera or settings out of range.
#pragma once

#include "partwise/base/progress.h"
#include "partwise/imaging/image.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/normals/truth/pinhole_camera.h"

namespace partwise {

struct DepthNormalSettings {
  // Standard deviation of the inverse depth, 1/m; 0: depths are exact. Half a step of a Kinect's disparity, 1/8 pixel
  // at 580 pixels of focal length and 75 mm between its eyes (Khoshelham and Elberink 2012).
  double noise = 0.5 / (8 * 580 * 0.075);
  int least_radius = 2, most_radius = 14;  // pixels, 1 to 100
  int least_pixels = 10;                   // that a plane is fitted to, at least 3
  double wanted_error = 3;                 // degrees; windows stop to grow where they expect less
  double most_error = 15;                  // degrees; where more is expected no normal is given
  double steepest = 85;                    // degrees, below 90; steps as of steeper surfaces part them
  int widest_gap = 2;                      // missing pixels in a row that a surface goes on behind
};

// Unit vectors, +x right, +y up, +z towards the camera, on the side that is seen; zero where the depth is missing or
// too little is known. depth: 1 channel, metres, 0 or less or not finite where missing.
Image normals_from_depth(const Image& depth, const PinholeCamera& camera, const DepthNormalSettings& settings = {},
                         const Progress& progress = {});

// 1 where there is a normal.
Mask known_normals(const Image& normals);

}  // namespace partwise
