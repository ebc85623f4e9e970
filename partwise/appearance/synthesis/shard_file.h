// A shard of a data set: a plain tar file of small files, as WebDataset reads it. The bytes depend on the entries alone
// (no times, no owners), and the file appears whole or not at all.
//
// Errors: InputError when the file cannot be written, or a name is longer than tar's 100 letters.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace partwise {

class ShardFile {
 public:
  explicit ShardFile(const std::filesystem::path& path);
  ~ShardFile();
  ShardFile(const ShardFile&) = delete;
  ShardFile& operator=(const ShardFile&) = delete;

  void add(const std::string& name, std::string_view bytes);
  void commit();

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

}  // namespace partwise
