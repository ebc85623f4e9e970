// What a data set of images is to hold, from JSON (docs/dataset.md).
//
// Files are named relative to the configuration's folder and stay so in the data, which then is the same wherever the
// folder lies. Every field is checked, and none may be there that is not known; patterns are expanded here, in the
// order of the alphabet, and what they name must be there. Errors: InputError with the file and the field's place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/scene_file.h"
#include "partwise/appearance/shapes/shape_file.h"

namespace partwise {

enum class ImageFormat { exr, png };

// What images are made of. Files are named relative to a folder.
struct DatasetSources {
  std::vector<ShapeFile> shapes;
  std::vector<std::string> materials;  // shipped ones by name, or files
  std::vector<std::string> lights;     // shipped ones by name, or files
};

struct DatasetConfig : DatasetSources {
  std::filesystem::path folder;  // where the files lie that it names
  PartSettings parts;
  double crease_degrees = 40;
  int light_width = 128, light_height = 64;
  RasterSize size{128, 128, 4};
  RenderPath path = RenderPath::reflectance_map;
  int map_size = 64;
  ShareView view{.azimuth = 0, .elevation = 20, .field_of_view = 0, .share = 0.45};  // the azimuth is drawn
  int viewpoints = 24, views = 5;
  std::uint64_t seed = 0;
  int images = 0, images_per_shard = 1000;
  ImageFormat format = ImageFormat::exr;
  std::filesystem::path output;
};

DatasetConfig read_dataset_config(const std::filesystem::path& path);

}  // namespace partwise
