// The images of a data set, each with what is known of its pixels, as files in memory: image (linear RGB in half
// precision, or tone-mapped), normals, mask and parts (rendering/channel_files.h), and the scene that renders it again.
//
// An image depends on the configuration and its number alone. Shapes (with their parts), materials and lights are read
// when they are first drawn, and kept; what cameras see, and materials made ready for maps, are kept as long as 256 MiB
// each hold them. So memory does not grow with the number of images. For any number of threads at a time. Errors:
// InputError of files that cannot be used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "partwise/appearance/synthesis/dataset_config.h"

namespace partwise {

struct NamedBytes {
  std::string name;  // key.image.exr, key.normal.png ...
  std::string bytes;
};

class DatasetImages {
 public:
  // Parts that take long (corise, cvf) are kept in a folder, where one is given: parts_folder/00012.seg of shape 12.
  explicit DatasetImages(DatasetConfig config, std::filesystem::path parts_folder = {});
  ~DatasetImages();
  DatasetImages(const DatasetImages&) = delete;
  DatasetImages& operator=(const DatasetImages&) = delete;

  // Five files an image, of `count` images from `first` on. Those of one combination share their materials and light:
  // ask for them together.
  std::vector<NamedBytes> render(std::uint64_t first, int count) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace partwise
