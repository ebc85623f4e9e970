#include "partwise/base/atomic_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, ReplacesOnCommitOnly) {
  const TestFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_file(path, "old");
  {
    AtomicFile file(path);
    file.stream() << "new";
    EXPECT_EQ(content(path), "old");
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(entries(folder.path()), 1u);
  write_file(path, "new");
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, FollowsLinks) {
  const TestFolder folder;
  write_file(folder.path() / "real", "old");
  fs::create_symlink("real", folder.path() / "link");
  write_file(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content(folder.path() / "real"), "new");
  fs::remove(folder.path() / "real");
  write_file(folder.path() / "link", "newer");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content(folder.path() / "real"), "newer");
}

TEST(AtomicFile, LinksInACircleCannotBeWritten) {
  const TestFolder folder;
  fs::create_symlink("b", folder.path() / "a");
  fs::create_symlink("a", folder.path() / "b");
  EXPECT_THROW(write_file(folder.path() / "a", ""), InputError);
}

TEST(AtomicFile, WritesDevicesInPlace) {
  write_file("/dev/null", "nothing");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT([] { write_file("/dev/full", "something"); }, ThrowsMessage<InputError>(HasSubstr("No space left")));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, SaysWhatCannotBeWritten) {
  const TestFolder folder;
  EXPECT_THAT([&] { write_file(folder.path(), ""); }, ThrowsMessage<InputError>(HasSubstr("is a folder")));
  EXPECT_THAT([&] { write_file(folder.path() / "none" / "a", ""); },
              ThrowsMessage<InputError>(HasSubstr("No such file or directory")));
}

}  // namespace
}  // namespace partwise
