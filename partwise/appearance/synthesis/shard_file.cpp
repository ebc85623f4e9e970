#include "partwise/appearance/synthesis/shard_file.h"

#include <archive.h>
#include <archive_entry.h>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr std::size_t kLongestName = 100;

la_ssize_t write_block(archive*, void* stream, const void* bytes, std::size_t size) {
  static_cast<std::ostream*>(stream)->write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  return static_cast<la_ssize_t>(size);  // a failure stays with the stream until commit
}

}  // namespace

struct ShardFile::Archive {
  explicit Archive(const std::filesystem::path& target) : path(target), file(target), writer(archive_write_new()) {
    archive_write_set_format_ustar(writer);
    archive_write_set_bytes_in_last_block(writer, 1);
    archive_write_open(writer, &file.stream(), nullptr, write_block, nullptr);
  }
  ~Archive() { archive_write_free(writer); }

  std::filesystem::path path;
  AtomicFile file;
  archive* writer;
};

ShardFile::ShardFile(const std::filesystem::path& path) : archive_(std::make_unique<Archive>(path)) {}
ShardFile::~ShardFile() = default;

void ShardFile::add(const std::string& name, std::string_view bytes) {
  if (name.empty() || name.size() > kLongestName) {
    throw InputError(archive_->path.string(), fmt::format("the entry \"{}\" has {} letters", name, name.size()),
                     fmt::format("give 1 to {}", kLongestName));
  }
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), &archive_entry_free);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_mtime(entry.get(), 0, 0);
  const bool written = archive_write_header(archive_->writer, entry.get()) == ARCHIVE_OK &&
                       archive_write_data(archive_->writer, bytes.data(), bytes.size()) >= 0;
  if (!written) {
    throw InputError(archive_->path.string(), archive_error_string(archive_->writer), "free some disk space");
  }
}

void ShardFile::commit() {
  archive_write_close(archive_->writer);
  archive_->file.commit();
}

}  // namespace partwise
