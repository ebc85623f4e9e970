// A file that appears whole or not at all: it is written beside its final name and renamed by commit().
//
// A symbolic link is followed. A device or a pipe (/dev/stdout, /dev/full) cannot be replaced and is written straight
// away.
//
// Errors: InputError when the folder does not exist or cannot be written, when the disk is full, or when the rename
// fails.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace partwise {

class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();  // Without commit() the temporary file is removed and the old file, if any, stays.
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::ofstream stream_;
  bool in_place_ = false;  // a device or a pipe
  bool committed_ = false;
};

// The file that writing to `path` reaches: symbolic links followed, also to a file that does not exist yet.
std::filesystem::path follow_links(std::filesystem::path path);

// True for what can be written but not replaced: devices, pipes, and open files named by number (/dev/stdout).
bool is_written_in_place(const std::filesystem::path& followed);

// Writes all bytes atomically.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace partwise
