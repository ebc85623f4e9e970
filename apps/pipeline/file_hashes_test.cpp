#include "pipeline/file_hashes.h"

#include <gtest/gtest.h>

#include <chrono>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise::pipeline {
namespace {

// The reference values of XXH3-128 with seed 0 for no bytes and for "abc".
TEST(FileHashes, AreThoseOfXxh3) {
  EXPECT_EQ(hash_of(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_of("abc"), "06b05ab6733a618578af5f94892f3950");
}

TEST(FileHashes, OfFilesAreThoseOfTheirBytes) {
  const TestFolder folder;
  FileHashes hashes(folder.path() / "kept");
  for (const std::size_t size : {0u, 5u, 3000000u}) {
    const std::string bytes(size, 'x');
    write_file(folder.path() / "a", bytes);
    EXPECT_EQ(hashes.of(folder.path() / "a"), hash_of(bytes));
  }
  EXPECT_THROW(hashes.of(folder.path() / "gone"), InputError);
}

TEST(FileHashes, AreKeptForOldFilesOnly) {
  const TestFolder folder;
  const auto file = folder.path() / "a", kept = folder.path() / "kept";
  write_file(file, "new");
  FileHashes hashes(kept);
  hashes.of(file);
  hashes.save();
  EXPECT_EQ(read_bytes(kept), "");  // it was written a moment ago, and may be written again within the same tick
  write_file(kept, "no hashes");
  EXPECT_EQ(FileHashes(kept).of(file), hash_of("new"));
}

}  // namespace
}  // namespace partwise::pipeline
