#include "partwise/appearance/synthesis/shard_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>

#include <map>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

using Entries = std::map<std::string, std::string>;

void write(const std::filesystem::path& path, const Entries& entries) {
  ShardFile shard(path);
  for (const auto& [name, bytes] : entries) shard.add(name, bytes);
  shard.commit();
}

Entries read(const std::filesystem::path& path) {
  Entries entries;
  archive* reader = archive_read_new();
  archive_read_support_format_tar(reader);
  EXPECT_EQ(archive_read_open_filename(reader, path.c_str(), 10240), ARCHIVE_OK);
  for (archive_entry* entry = nullptr; archive_read_next_header(reader, &entry) == ARCHIVE_OK;) {
    EXPECT_EQ(archive_entry_mtime(entry), 0);
    std::string bytes(static_cast<std::size_t>(archive_entry_size(entry)), ' ');
    EXPECT_EQ(archive_read_data(reader, bytes.data(), bytes.size()), static_cast<la_ssize_t>(bytes.size()));
    entries[archive_entry_pathname(entry)] = bytes;
  }
  archive_read_free(reader);
  return entries;
}

TEST(ShardFile, HoldsWhatWasAddedAndNothingElse) {
  const TestFolder folder;
  const Entries entries = {{"0.json", "{}"}, {"0.image.png", std::string(5000, '\xFF')}, {"1.json", ""}};
  write(folder.path() / "a.tar", entries);
  EXPECT_EQ(read(folder.path() / "a.tar"), entries);
  write(folder.path() / "b.tar", entries);
  EXPECT_EQ(read_bytes(folder.path() / "a.tar"), read_bytes(folder.path() / "b.tar"));
}

TEST(ShardFile, AppearsWholeOrNotAtAll) {
  const TestFolder folder;
  {
    ShardFile shard(folder.path() / "a.tar");
    shard.add("0.json", "{}");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ShardFile, RefusesWhatTarCannotHold) {
  const TestFolder folder;
  EXPECT_THROW(ShardFile(folder.path() / "no" / "a.tar"), InputError);
  ShardFile shard(folder.path() / "a.tar");
  EXPECT_THROW(shard.add(std::string(101, 'a'), ""), InputError);
}

TEST(ShardFile, SaysWhenTheDiskIsFull) {
  ShardFile shard("/dev/full");
  shard.add("0.bin", std::string(100000, 'a'));
  EXPECT_THROW(shard.commit(), InputError);
}

}  // namespace
}  // namespace partwise
