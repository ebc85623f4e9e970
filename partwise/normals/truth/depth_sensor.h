// What a depth sensor of structured light, as a Kinect's, would make of an exact depth: rounded, displaced, with holes.
//
// The sensor compares a projected pattern with a stored one; the projector stands `baseline` to the right of the
// camera, and a depth Z is found as a shift of focal * baseline / Z pixels. In this order:
//   shadow    what the projector does not see, since something nearer in its row of the picture is before it
//             (a strip on the left of near things, as wide as the difference of the shifts);
//   lateral   the depth is taken a random distance beside the pixel, `lateral` in both directions (half a pixel, Barron
//             and Malik 2013), on the same surface where that is possible;
//   shift     the shift errs by `shift_noise` (1/6 of a step there) and is rounded to `shift_step` (1/8 pixel; 580
//   pixels
//             and 75 mm, Khoshelham and Elberink 2012): the steps of depth grow with its square;
//   edges     beside a step of depth the pattern is torn: a share `edge_loss` is lost;
//   grazing   from `grazing_from` degrees between the normal and the way to the camera, a share is lost that grows
//             linearly to all at `grazing_to` (Nguyen, Izadi, Lovell 2012: errors soar from 60 to 70 degrees on);
//   mirrors   surfaces lose the share that the picture of mirrors says (dissertation, section 4.1: smooth and specular
//             materials give no accurate feedback);
//   range     what is not between `nearest` and `farthest` is lost.
// Losses at grazing angles and mirrors come in patches of some `patch` pixels, for the sensor compares windows.
//
// All draws are functions of the seed and the pixel. Linear time; the same bytes for any number of threads. Errors:
// CheckFailed for images that do not fit and settings out of range.
#pragma once

#include <cstdint>

#include "partwise/imaging/image.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/normals/truth/pinhole_camera.h"

namespace partwise {

struct DepthSensor {
  double focal = 580, baseline = 0.075;       // pixels and metres: of the sensor, whatever the picture's camera
  double shift_step = 1.0 / 8;                // pixels
  double shift_noise = 1.0 / 6;               // standard deviation, steps
  double lateral = 0.5;                       // standard deviation, pixels of the picture
  double edge_loss = 0.6;                     // share, 0 to 1
  double grazing_from = 70, grazing_to = 85;  // degrees from the surface's normal
  double nearest = 0.5, farthest = 8;         // metres
  double patch = 5;                           // pixels, at least 1
  bool shadow = true;

  // Of inverse depth, 1/m; half of it is the noise that normals_from_depth takes by default.
  double step() const { return shift_step / (focal * baseline); }
};

// depth: 1 channel, metres, 0 where nothing is. normals: of the surfaces, +z towards the camera, zero where nothing is.
// mirrors: 1 channel, the share of returns that are lost, 0 to 1. The result is like depth, 0 where missing.
Image sensed_depth(const Image& depth, const Image& normals, const Image& mirrors, const PinholeCamera& camera,
                   const DepthSensor& sensor, std::uint64_t seed);
// Without mirrors.
Image sensed_depth(const Image& depth, const Image& normals, const PinholeCamera& camera, const DepthSensor& sensor,
                   std::uint64_t seed);

}  // namespace partwise
