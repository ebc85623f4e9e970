// Pictures of rooms on disk (docs/rooms.md), laid out as RGB-D data is, so that what reads the one reads the other:
//
//   color/000000.png      the picture, 8 bits
//   depth/000000.png      what the sensor would make of it, 16 bits, millimetres, 0 where missing
//   intrinsics.txt        the camera's matrix
//   normals/000000.png    the exact normals, 16 bits (truth/normal_files.h)
//   materials/000000.png  which of the materials of truth/000000.json a pixel shows, counted from 1, 8 bits
//   truth/000000.json     these, by name and in 32 numbers (appearance/material/dsbrdf_basis.h); the light about the
//                         camera, RoomTruth::light_columns x light_rows of linear RGB, exposed as the picture is
//   rooms.json            what all was made from
//
// Depth and pictures are what real data has; what lies in the other three folders only such rooms know. A picture is
// exposed so that its median luminance is 0.18 times 2^-0.75 to 2^0.75.
//
// A frame depends on the configuration and its number alone, whatever the number of threads; frames that are there are
// kept, so that work that was stopped goes on. Errors: InputError with the file and the field's place; for a folder
// that holds rooms of another configuration; Cancelled, finished frames stay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "partwise/appearance/synthesis/dataset_config.h"
#include "partwise/base/progress.h"
#include "partwise/normals/scenes/room_picture.h"

namespace partwise {

struct RoomDatasetConfig : DatasetSources {
  std::filesystem::path folder;  // where the files lie that it names
  PartSettings parts;
  double height = 0;  // metres, of meshes that are no catalogue's; 0: they are in metres
  RoomSettings room;
  RoomWearSettings wear;
  RoomPictureSettings picture;
  int light_width = 64, light_height = 32;
  int images = 0;
  std::uint64_t seed = 0;
  std::filesystem::path output;
  std::string text;  // what makes these rooms other than the next; kept in rooms.json
};

// `seed`, unless it is 0, goes before the configuration's.
RoomDatasetConfig read_room_dataset_config(const std::filesystem::path& path, std::uint64_t seed = 0);

struct RoomDatasetReport {
  int made = 0, kept = 0;
  double seconds = 0;  // wall time, without reading the furniture
};

RoomDatasetReport make_room_dataset(const RoomDatasetConfig& config, const Progress& progress = {});

// What truth/ says of a frame.
struct RoomTruth {
  static constexpr int light_columns = 16, light_rows = 8;

  std::vector<std::string> names;             // of the materials
  std::vector<std::vector<float>> materials;  // 32 numbers each
  Image light;                                // in camera space
};

// Of the frame whose colours lie in that file; nothing where there is no such truth. Errors: InputError for a file that
// is damaged.
bool has_room_truth(const std::filesystem::path& colour);
RoomTruth read_room_truth(const std::filesystem::path& colour);
// Its exact normals, and its materials pixel by pixel, -1 where nothing is seen. Errors: InputError for a picture of
// another size as well.
std::filesystem::path room_normals_file(const std::filesystem::path& colour);
std::vector<int> read_room_materials(const std::filesystem::path& colour, int width, int height);

}  // namespace partwise
