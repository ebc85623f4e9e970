// The folder of a data set, and what it was made from. Internal to this room.
#pragma once

#include <filesystem>
#include <string>

#include "partwise/appearance/synthesis/dataset_config.h"

namespace partwise {

class DatasetFolder {
 public:
  // Makes the folder, or finds it made from the same: settings, names, and sizes of files. A folder without a shard may
  // have been made from anything.
  // Errors: InputError for a folder that cannot be made or holds shards that were made from something else.
  explicit DatasetFolder(const DatasetConfig& config);

  std::filesystem::path shard(int number) const;
  std::filesystem::path parts() const { return folder_ / "parts"; }

  // What a process that was killed has left of a shard.
  void remove_rest(int number) const;

 private:
  bool has_shards() const;

  std::filesystem::path folder_;
};

}  // namespace partwise
