#include "partwise/appearance/synthesis/shard_reader.h"

#include <archive.h>
#include <archive_entry.h>

#include <utility>

#include "partwise/appearance/synthesis/file_patterns.h"
#include "partwise/base/error.h"
#include "partwise/base/read_log.h"

namespace partwise {

struct ShardReader::Archive {
  std::filesystem::path path;
  archive* reader = archive_read_new();
  std::optional<std::pair<std::string, std::string>> ahead;  // name and bytes of the next file

  explicit Archive(std::filesystem::path file) : path(std::move(file)) {
    note_read(path);
    archive_read_support_format_tar(reader);
    constexpr std::size_t block = 1 << 16;
    if (!std::filesystem::is_regular_file(path) ||
        archive_read_open_filename(reader, path.c_str(), block) != ARCHIVE_OK) {
      throw InputError(path.string(), "is not there, or is no shard", "name a tar file that partwise dataset made");
    }
    advance();
  }
  ~Archive() { archive_read_free(reader); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  void advance() {
    ahead.reset();
    archive_entry* entry = nullptr;
    const int status = archive_read_next_header(reader, &entry);
    if (status == ARCHIVE_EOF) return;
    if (status != ARCHIVE_OK) damaged();
    const la_int64_t size = archive_entry_size(entry);
    constexpr la_int64_t most = la_int64_t{1} << 30;
    if (size < 0 || size > most) damaged();
    ahead.emplace(archive_entry_pathname(entry), std::string(static_cast<std::size_t>(size), '\0'));
    if (archive_read_data(reader, ahead->second.data(), ahead->second.size()) != size) damaged();
  }

  [[noreturn]] void damaged() const {
    throw InputError(path.string(), "is no shard, or is damaged or cut short",
                     "remove it and run partwise dataset again, which makes what is missing");
  }
};

ShardReader::ShardReader(std::filesystem::path path) : archive_(std::make_unique<Archive>(std::move(path))) {}
ShardReader::~ShardReader() = default;

std::optional<ShardImage> ShardReader::next() {
  auto& ahead = archive_->ahead;
  if (!ahead) return std::nullopt;
  ShardImage image;
  while (ahead) {
    const std::size_t dot = ahead->first.find('.');
    if (dot == std::string::npos) archive_->damaged();
    const std::string key = ahead->first.substr(0, dot);
    if (image.files.empty()) image.key = key;
    if (key != image.key) break;
    image.files.emplace(ahead->first.substr(dot + 1), std::move(ahead->second));
    archive_->advance();
  }
  return image;
}

std::vector<std::filesystem::path> shards_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> shards;
  for (const std::string& name : files_matching(folder, "shard-*.tar")) shards.push_back(folder / name);
  if (shards.empty()) {
    throw InputError(folder.string(), "holds no shards", "make them with partwise dataset, or name another folder");
  }
  return shards;
}

}  // namespace partwise
