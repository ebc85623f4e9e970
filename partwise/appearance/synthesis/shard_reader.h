// The images of a shard of a data set (docs/dataset.md), one after the other as they lie in the file.
//
// Errors: InputError for a file that is not there, is no tar file, or is damaged or cut short.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace partwise {

struct ShardImage {
  std::string key;                           // its number
  std::map<std::string, std::string> files;  // bytes by ending: "image.exr", "normal.png", "json"
};

class ShardReader {
 public:
  explicit ShardReader(std::filesystem::path path);
  ~ShardReader();
  ShardReader(const ShardReader&) = delete;
  ShardReader& operator=(const ShardReader&) = delete;

  std::optional<ShardImage> next();

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

// The shards of a folder, in order. Errors: InputError where there are none.
std::vector<std::filesystem::path> shards_of(const std::filesystem::path& folder);

}  // namespace partwise
