#include "partwise/base/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "partwise/base/error.h"

namespace partwise {

std::filesystem::path follow_links(std::filesystem::path path) {
  constexpr int most_links = 40;  // as the kernel; links in a circle stay as they are and fail when opened
  std::error_code error;
  for (int link = 0; link < most_links && std::filesystem::is_symlink(path, error); ++link) {
    // Links such as /proc/self/fd/1 hold no path: what they stand for may have no name at all.
    if (path.native().starts_with("/proc/")) break;
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return path;
}

bool is_written_in_place(const std::filesystem::path& followed) {
  std::error_code error;
  if (std::filesystem::is_symlink(followed, error)) return true;
  const std::filesystem::file_status status = std::filesystem::status(followed, error);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(follow_links(std::move(path))) {
  std::error_code error;
  if (std::filesystem::is_directory(path_, error)) {
    throw InputError(path_.string(), "is a folder", "name a file in it");
  }
  in_place_ = is_written_in_place(path_);
  temporary_ = path_;
  if (!in_place_) temporary_ += fmt::format(".{}.tmp", ::getpid());
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throw InputError(path_.string(), fmt::format("cannot be written ({})", std::strerror(errno)),
                     "name a file in a folder that exists and that you may write to");
  }
}

AtomicFile::~AtomicFile() {
  if (committed_ || in_place_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (stream_.fail()) {
    throw InputError(path_.string(), fmt::format("writing failed ({})", std::strerror(errno)), "free some disk space");
  }
  std::error_code error;
  if (!in_place_) std::filesystem::rename(temporary_, path_, error);
  if (error) {
    throw InputError(path_.string(), fmt::format("cannot be replaced ({})", error.message()),
                     "name a file, not a folder, in a folder that you may write to");
  }
  committed_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

}  // namespace partwise
