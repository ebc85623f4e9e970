#include "partwise/base/read_log.h"

#include <gmock/gmock.h>

#include "partwise/base/atomic_file.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

TEST(ReadLog, KeepsNamesOnceAskedTo) {
  const TestFolder folder;
  const auto a = folder.path() / "a.txt", b = folder.path() / "b.txt";
  for (const auto& each : {a, b}) write_file(each, "x");
  read_bytes(a);
  EXPECT_TRUE(files_read().empty());
  keep_read_log();
  for (const auto& each : {b, a, b}) read_bytes(each);
  EXPECT_THAT(files_read(), testing::ElementsAre(a, b));
}

}  // namespace
}  // namespace partwise
