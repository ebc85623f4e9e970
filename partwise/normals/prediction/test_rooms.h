// A few rooms that the tests of this folder share, made once a test program. Tests only; not installed.
#pragma once

#include <filesystem>
#include <string>

#include "partwise/base/atomic_file.h"
#include "partwise/base/test_folder.h"
#include "partwise/normals/scenes/room_dataset.h"

namespace partwise::test {

inline const std::filesystem::path& rooms_folder() {
  static const TestFolder folder;
  static const std::filesystem::path path = [] {
    const std::filesystem::path file = folder.path() / "rooms.json";
    write_file(file, R"({"shapes": [")" + std::string(PARTWISE_TEST_DATA) + R"(/data/models/chair.off"], "height": 0.9,
      "materials": ["pink-felt", "nylon", "blue-rubber"], "lights": ["studio"], "size": [64, 48], "map_size": 12, "images": 4})");
    RoomDatasetConfig config = read_room_dataset_config(file);
    config.output = folder.path() / "rooms";
    make_room_dataset(config);
    return config.output;
  }();
  return path;
}

}  // namespace partwise::test
