// What files hold, in 128 bits (XXH3). Hashes are kept from run to run for files that were not touched since: the same
// device and inode, size, and times of the last change. A file of the last two seconds is hashed again next time, for
// clocks of file systems are coarse.
//
// Errors: InputError for a file that cannot be read, or a memory that cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace partwise::pipeline {

std::string hash_of(std::string_view bytes);  // 32 hexadecimal digits

class FileHashes {
 public:
  // `memory` is the file in which hashes are kept. One that is not there, or not ours, is as an empty one.
  explicit FileHashes(std::filesystem::path memory);

  std::string of(const std::filesystem::path& file);

  // Remembers what was asked for since the beginning.
  void save() const;

 private:
  struct Seen {
    std::uint64_t bytes = 0;
    std::int64_t modified = 0, changed = 0;  // nanoseconds
    std::string hash;

    bool operator==(const Seen& other) const = default;
  };
  using Place = std::pair<std::uint64_t, std::uint64_t>;  // device and inode

  std::filesystem::path memory_;
  std::map<Place, Seen> before_, now_;
};

}  // namespace partwise::pipeline
