// What a camera in a room (room.h) sees, with the truth behind it and with what a depth sensor would make of it: data
// to learn normals of scenes from as they are learnt from real ones, by noisy truth, and to judge them by the exact
// one.
//
// The picture is formed by the sum (3.2), each pixel in its material (room_wear.h), with a constant view and without
// shadows, under a light in world space. Sensed depth is that of truth/depth_sensor.h, the noisy normals those that
// truth/depth_normals.h finds in it. Materials that mirror return less to the sensor (mirror_share).
//
// All as large as asked for; the same bytes for any number of threads. Errors: CheckFailed for lists of unequal length.
#pragma once

#include <cstdint>
#include <vector>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/normals/scenes/room.h"
#include "partwise/normals/scenes/room_wear.h"
#include "partwise/normals/truth/depth_sensor.h"

namespace partwise {

struct RoomPicture {
  Image image;                 // 3 channels, linear
  Image normals;               // exact, of the pixel's middle: 3 channels, camera space, zero where nothing is seen
  Image depth;                 // likewise: 1 channel, metres, along the view
  std::vector<int> materials;  // likewise: of the wear, pixel by pixel, -1 where nothing is seen
  Image sensed;                // depth as the sensor has it, 0 where missing
  Image noisy_normals;         // of the sensed depth, zero where unknown
};

struct RoomPictureSettings {
  RasterSize size{160, 120, 4};  // samples of the image
  int map_size = 48;             // of reflectance maps
  DepthSensor sensor{};
  std::uint64_t seed = 0;  // of the sensor's noise
};

RoomPicture room_picture(const Room& room, const RoomWear& wear, const EnvironmentLight& light,
                         const RoomPictureSettings& settings = {});

}  // namespace partwise
