#include "partwise/appearance/shapes/zip_entry.h"

#include <archive.h>
#include <archive_entry.h>

#include <memory>

#include "partwise/base/error.h"
#include "partwise/base/read_log.h"

namespace partwise {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{1} << 28;
constexpr std::size_t kBlock = 1 << 16;

using Reader = std::unique_ptr<archive, decltype(&archive_read_free)>;

[[noreturn]] void damaged(const std::string& place) {
  throw InputError(place, "the archive is damaged there or cut short", "get it again");
}

std::string read_data(archive* reader, const std::string& place) {
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    if (static_cast<std::int64_t>(before) > kMostBytes) {
      throw InputError(place, fmt::format("holds more than {} MiB", kMostBytes >> 20), "unpack and reduce it first");
    }
    bytes.resize(before + kBlock);
    const la_ssize_t got = archive_read_data(reader, bytes.data() + before, kBlock);
    if (got < 0) damaged(place);
    bytes.resize(before + static_cast<std::size_t>(got));
    if (got == 0) return bytes;
  }
}

}  // namespace

std::string read_zip_entry(const std::filesystem::path& path, const std::string& entry) {
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(path.string(), "is not there, or is no file", "name a zip archive");
  }
  note_read(path);
  const Reader reader(archive_read_new(), &archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());
  if (archive_read_open_filename(reader.get(), path.c_str(), kBlock) != ARCHIVE_OK) {
    throw InputError(path.string(), "is no zip archive, or is cut short", "give a .sh3f or .zip file, or get it again");
  }
  const std::string place = path.string() + ":" + entry;
  archive_entry* header = nullptr;
  for (;;) {
    const int status = archive_read_next_header(reader.get(), &header);
    if (status == ARCHIVE_EOF) break;
    if (status != ARCHIVE_OK && status != ARCHIVE_WARN) damaged(path.string());
    const char* name = archive_entry_pathname(header);
    if (name != nullptr && entry == name) return read_data(reader.get(), place);
  }
  throw InputError(place, "the archive has no such entry", "see what it holds, with unzip -l for example");
}

}  // namespace partwise
