// What a camera in a room (room.h) sees, with the truth behind it and with what a depth sensor would make of it: data
// to learn normals of scenes from as they are learnt from real ones, by noisy truth, and to judge them by the exact
// one.
//
// The picture is formed by the sum (3.2), each part in a material, with a constant view and without shadows, under a
// light in world space. Sensed depth is that of truth/depth_sensor.h, the noisy normals those that
// truth/depth_normals.h finds in it. Parts whose material mirrors return less to the sensor: their share of losses is
// that of the light that the material sends back the mirror's way, see mirror_share.
//
// All as large as asked for; the same bytes for any number of threads. Errors: CheckFailed for lists of unequal length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/normals/scenes/room.h"
#include "partwise/normals/truth/depth_sensor.h"

namespace partwise {

struct RoomPicture {
  Image image;             // 3 channels, linear
  Image normals;           // exact, of the pixel's middle: 3 channels, camera space, zero where nothing is seen
  Image depth;             // likewise: 1 channel, metres, along the view
  std::vector<int> parts;  // likewise: pixel by pixel, -1 where nothing is seen
  Image sensed;            // depth as the sensor has it, 0 where missing
  Image noisy_normals;     // of the sensed depth, zero where unknown
};

struct RoomPictureSettings {
  RasterSize size{160, 120, 4};  // samples of the image
  int map_size = 48;             // of reflectance maps
  DepthSensor sensor;
  std::uint64_t seed = 0;  // of the sensor's noise
};

// materials: one a part of the room.
RoomPicture room_picture(const Room& room, std::span<const DsbrdfCoefficients> materials, const EnvironmentLight& light,
                         const RoomPictureSettings& settings = {});

// Of a sensor's returns, the share that a material loses for it throws light the mirror's way and not back: 0 up to a
// peak over the half-vector of twice the value 45 degrees beside it, 0.9 from a thousand times on, by the logarithm in
// between; of normal incidence, the largest channel.
double mirror_share(const DsbrdfCoefficients& material);

}  // namespace partwise
