#include "partwise/base/read_bytes.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "partwise/base/error.h"
#include "partwise/base/read_log.h"

namespace partwise {

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InputError(path.string(), "does not exist", "check the name and the folder");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(path.string(), std::filesystem::is_directory(status) ? "is a folder" : "is not a regular file",
                     "name a file");
  }
  note_read(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::string bytes;
  if (stream && !error) {
    bytes.resize(size);
    stream.read(bytes.data(), static_cast<std::streamsize>(size));
  }
  if (!stream || error) {
    throw InputError(path.string(), fmt::format("cannot be read ({})", std::strerror(errno)),
                     "check that you may read it");
  }
  return bytes;
}

}  // namespace partwise
