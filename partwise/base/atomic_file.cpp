#include "partwise/base/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "partwise/base/error.h"

namespace partwise {

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  temporary_ = path_;
  temporary_ += fmt::format(".{}.tmp", ::getpid());
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throw InputError(path_.string(), fmt::format("cannot be written ({})", std::strerror(errno)),
                     "name a file in a folder that exists and that you may write to");
  }
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
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
  std::filesystem::rename(temporary_, path_, error);
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
